#include "app/check_command.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "app/command_line.hpp"
#include "app/demands.hpp"
#include "app/encounters.hpp"
#include "app/machine.hpp"
#include "app/messages.hpp"
#include "app/stress_balance.hpp"
#include "app/warnings.hpp"
#include "integrators/grid/critical_step.hpp"
#include "integrators/grid/error_scales.hpp"
#include "integrators/grid/grid_method.hpp"
#include "output/particle_fields.hpp"
#include "scene/build_system.hpp"
#include "scene/choices.hpp"
#include "scene/input_text.hpp"
#include "scene/read_scene.hpp"
#include "scene/shape_measures.hpp"
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
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    const Body& body = system.bodies[n];
    const ShapeMeasures exact = measures(scene.bodies[n], scene.geometry);
    double mass = 0.0;
    for (const double m : body.particles.mass) mass += m * whole;
    bodies[body.name] = {
        {"particles", body.particles.size},
        {"mass", mass},
        {"exact_mass", body.material->density() * whole * (system.axisymmetric ? exact.moment : exact.area)},
        {"material", body.material->parameters().name},
        {"wave_speed", body.material->wave_speed()}};
    if (const auto balance = stress_balance(system, body))
      bodies[body.name]["stress"] = {
          {"largest", balance->largest}, {"force", balance->force}, {"moment", balance->moment}};
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
          {"output_seconds", output_seconds(scene, system)},
          {"seconds_most", most_seconds(scene, system, work, threads)},
          {"particle_steps_a_second", particle_steps_a_second},
          {"bodies", bodies},
          {"critical_step", critical.step},
          {"critical_body", critical.body},
          {"critical_contact", critical.touching.empty() ? json(nullptr) : json(critical.touching)},
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
  const char* unit = system.axisymmetric ? "kg" : "kg/m";
  for (const auto& [name, body] : facts["bodies"].items())
    text += fmt::format(
        "# body '{}': {} particles of {:.6g} {} (exact: {:.6g} {}), material '{}', wave speed {:.5g} m/s\n",
        name, body["particles"].get<std::size_t>(), body["mass"].get<double>(), unit,
        body["exact_mass"].get<double>(), unit, body["material"].get<std::string>(),
        body["wave_speed"].get<double>());
  for (const auto& [name, body] : facts["bodies"].items())
    if (body.contains("stress"))
      text += fmt::format(
          "# body '{}': initial stress up to {:.4g} Pa; a mean section of it carries a force of {:.3g} N/m "
          "and a moment "
          "of {:.3g} N, in equilibrium without loads none\n",
          name, body["stress"]["largest"].get<double>(), body["stress"]["force"].get<double>(),
          body["stress"]["moment"].get<double>());
  text += fmt::format("# {} particles; a run takes about {} of memory ({} available) and {} of disk space\n",
                      system.particle_count(), bytes_text(size.memory), bytes_text(available_memory()),
                      bytes_text(disk_space_of(scene, system, true)));
  text += fmt::format("# {}about {} on {} thread{}, at {:g} particle-steps a second and thread\n",
                      work.is_planned ? "" : "at least ", duration_text(work.seconds), threads,
                      threads == 1 ? "" : "s", particle_steps_a_second);
  text += fmt::format("#   and about {} for the outputs\n", duration_text(output_seconds(scene, system)));
  if (scene.constitutive.method != LocalMethod::closed_form)
    text += fmt::format(
        "#   while increments are elastic; about {} if none were (measured now with constitutive.method = "
        "\"{}\")\n",
        duration_text(facts["seconds_most"].get<double>()), name_of(scene.constitutive.method));
  for (const Body& body : system.bodies)
    if (scene.constitutive.method != LocalMethod::closed_form && body.material->event_driven() == nullptr)
      text += fmt::format(
          "# body '{}': the law of material '{}' is taken in closed form, whatever constitutive.method "
          "says\n",
          body.name, body.material->parameters().name);
  text += fmt::format(
      "# critical step {}{:.6g} s (body '{}'{})\n",
      scene.integrator.method == GridMethod::arkode_implicit ? "(explicit MUSL's, for comparison) " : "",
      facts["critical_step"].get<double>(), facts["critical_body"].get<std::string>(),
      contact_text(critical_step_of(scene.integrator, system)));
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

int check_scene(const CheckOptions& options) {
  const InputText input = show_lines_of(read_input(options.scene), options.overrides);
  const Scene scene = parse_scene(input.text, input.name, options.overrides);
  const SceneSize size = size_of(scene);
  require_memory(scene, size);
  Scene as_given = scene;  // not relaxed
  for (BodyDefinition& body : as_given.bodies) body.relax = false;
  const System system = build_system(as_given, 1);
  const int threads = thread_count(scene, system, available_threads());
  output::select_fields(scene, output::materials_of(system.bodies));  // throws InputError
  const Work work = work_of(scene, system, threads);
  require_time(scene, system, work, threads);
  require_clock(scene, system);
  const std::vector<std::string> warned = warnings(scene, system, threads);
  nlohmann::ordered_json facts = derived(scene, system, size, work, threads);
  const StartGeometry geometry = start_geometry(scene, system);
  if (options.json) {
    facts.update(to_json(geometry, scene));
    facts["warnings"] = warned;
    facts["resolved"] = resolved_toml(scene);
    show(facts.dump(2) + '\n');
    return exit_done;
  }
  for (const std::string& w : warned) warn(w);
  show(readable(input.name, scene, system, facts, size, work, threads) + to_text(geometry, scene) + '\n' +
       resolved_toml(scene));
  return exit_done;
}

}  // namespace vitrum::app
