#include "app/check_command.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/command_line.hpp"
#include "app/demands.hpp"
#include "app/machine.hpp"
#include "app/messages.hpp"
#include "integrators/grid/critical_step.hpp"
#include "integrators/grid/error_scales.hpp"
#include "output/particle_fields.hpp"
#include "scene/build_system.hpp"
#include "scene/grid_method.hpp"
#include "scene/read_scene.hpp"
#include "scene/thread_count.hpp"
#include "scene/toml_text.hpp"
#include "scene/write_scene.hpp"

namespace vitrum::app {
namespace {

/// What the tolerances of an adaptive method are relative to.
nlohmann::ordered_json scales_of(const IntegratorDefinition& integrator, const System& system) {
  if (integrator.method == GridMethod::explicit_steps) return nullptr;
  const ErrorScales s = error_scales(system, {integrator.velocity_scale, integrator.strain_scale});
  return {{"velocity", s.velocity}, {"strain", s.strain}, {"length", s.length}};
}

nlohmann::ordered_json derived(const Scene& scene, const System& system, const SceneSize& size,
                               const Work& work, int threads) {
  using json = nlohmann::ordered_json;
  const double whole = system.axisymmetric ? 2.0 * std::numbers::pi : 1.0;
  json bodies = json::object();
  for (const Body& body : system.bodies) {
    double mass = 0.0;
    for (const double m : body.particles.mass) mass += m * whole;
    bodies[body.name] = {{"particles", body.particles.size},
                         {"mass", mass},
                         {"material", body.material->parameters().name},
                         {"wave_speed", body.material->wave_speed()}};
  }
  const CriticalStep critical = critical_step_of(scene.integrator, system);
  const std::optional<double> step = planned_step(scene.integrator, critical);
  const auto known = [](std::optional<double> value) { return value ? json(*value) : json(nullptr); };
  const auto of_step = [&](auto&& f) { return step ? known(f(*step)) : json(nullptr); };
  return {{"title", scene.title},
          {"particles", system.particle_count()},
          {"memory_bytes", size.memory},
          {"memory_available", available_memory()},
          {"disk_bytes", disk_space_of(scene, system, true)},
          {"threads", threads},
          {"seconds", work.seconds},
          {"particle_steps_a_second", particle_steps_a_second},
          {"bodies", bodies},
          {"critical_step", critical.step},
          {"critical_body", critical.body},
          {"step", known(step)},
          {"step_to_critical", of_step([&](double s) { return s / critical.step; })},
          {"steps", work.is_planned ? json(work.steps) : json(nullptr)},
          {"least_steps", work.steps},
          {"scales", scales_of(scene.integrator, system)}};
}

/// The facts as comments of a TOML file.
std::string readable(const std::string& file, const Scene& scene, const System& system,
                     const nlohmann::ordered_json& facts, const SceneSize& size, const Work& work,
                     int threads) {
  std::string text = fmt::format("# {} is valid\n", scene::single_line(file));
  for (const auto& [name, body] : facts["bodies"].items())
    text += fmt::format("# body '{}': {} particles, {:.6g} {}, material '{}', wave speed {:.5g} m/s\n", name,
                        body["particles"].get<std::size_t>(), body["mass"].get<double>(),
                        system.axisymmetric ? "kg" : "kg/m", body["material"].get<std::string>(),
                        body["wave_speed"].get<double>());
  text += fmt::format("# {} particles; a run takes about {} of memory ({} available) and {} of disk space\n",
                      system.particle_count(), bytes_text(size.memory), bytes_text(available_memory()),
                      bytes_text(disk_space_of(scene, system, true)));
  text += fmt::format("# {}about {} on {} thread{}, at {:g} particle-steps a second and thread\n",
                      work.is_planned ? "" : "at least ", duration_text(work.seconds), threads,
                      threads == 1 ? "" : "s", particle_steps_a_second);
  text += fmt::format(
      "# critical step {}{:.6g} s (body '{}')\n",
      scene.integrator.method == GridMethod::arkode_implicit ? "(explicit MUSL's, for comparison) " : "",
      facts["critical_step"].get<double>(), facts["critical_body"].get<std::string>());
  if (facts["step"].is_number())
    text += fmt::format("# step {:.6g} s, ratio {:.4g}; {:.0f} steps\n", facts["step"].get<double>(),
                        facts["step_to_critical"].get<double>(), facts["steps"].get<double>());
  if (facts["scales"].is_object())
    text += fmt::format("# tolerances relative to: velocity {:.4g} m/s, strain {:.4g}, length {:.4g} m\n",
                        facts["scales"]["velocity"].get<double>(), facts["scales"]["strain"].get<double>(),
                        facts["scales"]["length"].get<double>());
  return text;
}

}  // namespace

std::vector<std::string> warnings(const Scene& scene, const System& system, int threads) {
  std::vector<std::string> list;
  if (const Work work = work_of(scene, system, threads); work.seconds > long_run)
    list.push_back(fmt::format("time.end: {}{:.3g} steps of {} particles take about {} on {} threads",
                               work.is_planned ? "" : "at least ", work.steps, system.particle_count(),
                               duration_text(work.seconds), threads));
  const GridMethod method = scene.integrator.method;
  const CriticalStep critical = critical_step_of(scene.integrator, system);
  const double step = planned_step(scene.integrator, critical).value_or(0.0);
  if (method != GridMethod::arkode_implicit && step > critical.step)
    list.push_back(
        fmt::format("{}: {:.4g} s is {:.3g} times the critical step {:.4g} s (body '{}': wave speed {:.4g} "
                    "m/s, fastest particle {:.4g} m/s); energy will grow",
                    step_key(scene.integrator), step, step / critical.step, critical.step, critical.body,
                    critical.wave_speed, critical.travel_speed));
  if (method == GridMethod::explicit_steps && scene.integrator.scheme == ExplicitScheme::usl)
    list.push_back(
        "integrator.scheme: \"usl\" has no stable step where the edge of a body leaves a node nearly empty; "
        "\"usf\" and "
        "\"musl\" have");
  if (method == GridMethod::arkode_implicit && scene.shape_functions != ShapeFunctions::bspline2)
    for (const BodyDefinition& body : scene.bodies)
      if (body.particles_per_cell == 1 && scene.integrator.remap > 20.0 * critical.step) {
        list.push_back(
            fmt::format("integrator.remap: with one particle a cell (body '{}') the grid has motions that no "
                        "particle sees and "
                        "only a remap removes; in phases of {:g} s they make bodies too soft; use "
                        "particles_per_cell = 4 or "
                        "shorter phases",
                        body.name, scene.integrator.remap));
        break;
      }
  for (const MaterialParameters& m : scene.materials) {
    if (!m.decohesion || !m.von_mises) continue;
    // A plane on which the traction falls faster than the cell behind it can unload releases at once.
    const Moduli moduli = elastic_moduli(m.elastic);
    const double needed = m.von_mises->peak * scene.cell / moduli.p_wave();
    if (m.decohesion->opening < needed && m.decohesion->viscosity == 0.0)
      list.push_back(
          fmt::format("material.{}.decohesion.opening: {:.3g} m is below {:.3g} m, where decohesion snaps "
                      "back on cells of "
                      "{:g} m: it will be instantaneous",
                      m.name, m.decohesion->opening, needed, scene.cell));
  }
  return list;
}

int check_scene(const CheckOptions& options) {
  const Scene scene = read_scene(options.scene, options.overrides);
  const SceneSize size = size_of(scene);
  require_memory(scene, size);
  const System system = build_system(scene, 1);
  const int threads = thread_count(scene, system, available_threads());
  output::select_fields(scene, output::materials_of(system.bodies));  // throws InputError
  const Work work = work_of(scene, system, threads);
  require_time(scene, system, work, threads);
  const std::vector<std::string> warned = warnings(scene, system, threads);
  nlohmann::ordered_json facts = derived(scene, system, size, work, threads);
  if (options.json) {
    facts["warnings"] = warned;
    facts["resolved"] = resolved_toml(scene);
    show(facts.dump(2) + '\n');
    return exit_done;
  }
  for (const std::string& w : warned) tell("warning: {}\n", w);
  show(readable(options.scene, scene, system, facts, size, work, threads) + '\n' + resolved_toml(scene));
  return exit_done;
}

}  // namespace vitrum::app
