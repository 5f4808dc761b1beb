#include "app/warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "app/demands.hpp"
#include "app/encounters.hpp"
#include "app/idle_loads.hpp"
#include "app/magnitudes.hpp"
#include "app/material_warnings.hpp"
#include "app/plausibility.hpp"
#include "app/solver_advice.hpp"
#include "integrators/grid/grid_method.hpp"
#include "observe/probes.hpp"
#include "scene/boundary_checks.hpp"
#include "scene/input_error.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::app {
namespace {

constexpr const char* place_names[] = {"point", "line", "box"};

/// A probe that looks at nothing, or far from where it was meant to.
void judge_probes(const Scene& scene, const System& system, Warnings& list) {
  for (std::size_t n = 0; n < scene.probes.size(); ++n) {
    const ProbeDefinition& probe = scene.probes[n];
    const Probed probed = find_probed(probe, system.bodies[body_of(probe, system)]);
    const std::string key = fmt::format("probe.{}.{}", n, place_names[probe.place.index()]);
    if (probed.particles.empty())
      throw InputError(fmt::format("{}: found a box without a particle of body '{}', expected some",
                                   scene.at(key), probe.body));
    if (probed.farthest > system.cell)
      list.push_back(fmt::format("{}: the nearest particle of body '{}' is {:.3g} m away, more than a cell",
                                 scene.at(key), probe.body, probed.farthest));
  }
}

void warn_of_duration(const Scene& scene, const System& system, const Work& work, int threads,
                      Warnings& list) {
  if (work.seconds > long_run)
    list.push_back(fmt::format("{}: {}{:.3g} steps of {} particles take about {} on {} threads",
                               scene.at("time.end"), work.is_planned ? "" : "at least ", work.steps,
                               system.particle_count(), duration_text(work.seconds), threads));
}

void warn_of_step(const Scene& scene, const CriticalStep& critical, Warnings& list) {
  const double step = planned_step(scene.integrator, critical).value_or(0.0);
  if (scene.integrator.method != GridMethod::arkode_implicit && step > critical.step)
    list.push_back(
        fmt::format("{}: {:.4g} s is {:.3g} times the critical step {:.4g} s (body '{}': wave speed {:.4g} "
                    "m/s, fastest particle {:.4g} m/s{}); energy will grow",
                    scene.at(step_key(scene.integrator)), step, step / critical.step, critical.step,
                    critical.body, critical.wave_speed, critical.travel_speed, contact_text(critical)));
}

void warn_of_scheme(const Scene& scene, Warnings& list) {
  if (scene.integrator.method == GridMethod::explicit_steps && scene.integrator.scheme == StepScheme::usl)
    list.push_back(fmt::format(
        "{}: \"usl\" has no stable step where the edge of a body leaves a node nearly empty; \"usf\" and "
        "\"musl\" have",
        scene.at("integrator.scheme")));
}

/// One particle a cell off the middles of cells: wide functions have a shear there that no particle sees, and
/// what it can move bears no stress in equilibrium (docs/theory/loads.md).
void warn_of_relaxation(const Scene& scene, Warnings& list) {
  if (scene.shape_functions == mpm::ShapeKind::linear) return;
  for (std::size_t n = 0; n < scene.bodies.size(); ++n) {
    const BodyDefinition& body = scene.bodies[n];
    const Box* box = std::get_if<Box>(&body.shape);
    if (!body.relax || body.particles_per_cell > 1 || box == nullptr) continue;
    double off = 0.0;
    for (const Vector2& corner : {box->min, box->max})
      for (const double x : corner)
        off = std::max(off, std::abs(x / scene.cell - std::round(x / scene.cell)));
    if (off > 1e-6)
      list.push_back(fmt::format(
          "{}: the faces of body '{}' are up to {:.2g} cells off the lines of the grid: with one particle a "
          "cell a stress that varies across it is then lost in equilibrium, up to all of it at a face; place "
          "them on lines or use particles_per_cell = 4",
          scene.at(fmt::format("body.{}.relax", n)), body.name, off));
  }
}

/// A plane on which the traction falls faster than the cell behind it can unload releases at once.
void warn_of_snap_back(const Scene& scene, Warnings& list) {
  for (const MaterialParameters& m : scene.materials) {
    if (!m.decohesion || !m.von_mises) continue;
    const double needed = m.von_mises->peak * scene.cell / elastic_moduli(m.elastic).p_wave();
    if (m.decohesion->opening < needed && m.decohesion->viscosity == 0.0)
      list.push_back(fmt::format(
          "{}: {:.3g} m is below {:.3g} m, where decohesion snaps back on cells of {:g} m: it will be "
          "instantaneous",
          scene.at(fmt::format("material.{}.decohesion.opening", m.name)), m.decohesion->opening, needed,
          scene.cell));
  }
}

}  // namespace

Warnings warnings(const Scene& scene, const System& system, int threads) {
  Warnings list = scene.warnings;
  std::ranges::move(boundary_warnings(scene), std::back_inserter(list));
  const CriticalStep critical = critical_step_of(scene.integrator, system);
  judge_probes(scene, system, list);
  const Work work = work_of(scene, system, threads);
  warn_of_duration(scene, system, work, threads, list);
  warn_of_magnitudes(scene, system, work, list);
  warn_of_step(scene, critical, list);
  warn_of_scheme(scene, list);
  warn_of_factors(scene, system, list);
  warn_of_relaxation(scene, list);
  warn_of_snap_back(scene, list);
  for (const MaterialParameters& m : scene.materials)
    std::ranges::move(material_warnings(m), std::back_inserter(list));
  warn_of_motion(scene, system, list);
  warn_of_travel(scene, system, list);
  warn_of_one_row(scene, list);
  warn_of_scatter(scene, system, list);
  warn_of_idle_loads(scene, system, list);
  warn_of_geometry(scene, system, list);
  for (std::string& line : list) line = scene::single_line(line);  // the name of a file may have several
  return list;
}

}  // namespace vitrum::app
