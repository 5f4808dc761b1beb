#include "app/demands.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "app/local_cost.hpp"
#include "app/machine.hpp"
#include "output/particle_fields.hpp"
#include "integrators/grid/grid_method.hpp"
#include "scene/input_error.hpp"

namespace vitrum::app {
namespace {

/// Evaluations of all particles that a step takes (implicit: at the least; Newton iterations of its stages).
double evaluations_of_step(const IntegratorDefinition& integrator) {
  return integrator.method == GridMethod::explicit_steps ? 1.0 : butcher_table(integrator).stages;
}

/// `value` with the largest unit that it reaches.
template <std::size_t n>
std::string with_unit(double value, const std::array<std::pair<double, const char*>, n>& units) {
  auto unit = units.begin();
  while (unit + 1 != units.end() && value >= (unit + 1)->first) ++unit;
  return fmt::format("{:.3g} {}", value / unit->first, unit->second);
}

/// Outputs or checkpoints at the multiples of an interval, besides those at the ends.
double multiples(const Scene& scene, const std::optional<double>& interval) {
  return interval ? std::floor((scene.end - scene.start) / *interval) : 0.0;
}

/// No fewer than a run makes.
double outputs_of(const Scene& scene) {
  return multiples(scene, scene.output.every) + (scene.output.every ? 2.0 : 1.0);
}

/// Bytes of the histories, in their files and in tables.h5. (How many events there will be is not known.)
double tables_space(const Scene& scene, const System& system) {
  constexpr double of_row = 250.0;
  std::size_t rows = system.bodies.size() + scene.boundaries.size();
  for (const ProbeDefinition& probe : scene.probes)
    rows += std::holds_alternative<Box>(probe.place) ? 1 : probe.points().size();
  if (scene.contact.method == ContactMethod::bodies)
    rows += system.bodies.size() * (system.bodies.size() - 1) / 2;
  const double times =
      scene.output.history_every ? multiples(scene, scene.output.history_every) + 2.0 : outputs_of(scene);
  return of_row * times * static_cast<double>(rows);
}

/// What an earlier run's outputs and checkpoint take.
double size_of_outputs(const std::filesystem::path& folder) {
  std::error_code failure;
  double bytes = 0.0;
  const auto add = [&](const std::filesystem::path& file) {
    if (const std::uintmax_t size = std::filesystem::file_size(file, failure); !failure)
      bytes += static_cast<double>(size);
  };
  for (const auto& entry : std::filesystem::directory_iterator(folder / "steps", failure)) add(entry.path());
  add(folder / "result.h5"), add(folder / "checkpoint.h5");
  return bytes;
}

}  // namespace

std::string step_key(const IntegratorDefinition& i) {
  if (i.fixed_step && i.method != GridMethod::explicit_steps) return "integrator.fixed_step";
  if (i.method == GridMethod::arkode_implicit) return i.remap ? "integrator.remap" : "time.end";
  if (i.method == GridMethod::explicit_steps) return i.step ? "integrator.step" : "integrator.courant";
  return "space.cell";
}

CriticalStep critical_step_of(const IntegratorDefinition& integrator, const System& system) {
  switch (integrator.method) {
    case GridMethod::explicit_steps:
      return critical_step(system, stability_limit(integrator.scheme), Touching::any);
    case GridMethod::arkode_explicit:
      return critical_step(system, butcher_table(integrator).oscillation_limit() / std::sqrt(8.0),
                           Touching::any);
    case GridMethod::arkode_implicit:
      return critical_step(system, stability_limit(StepScheme::musl), Touching::any);
  }
  return {};
}

std::string contact_text(const CriticalStep& critical) {
  return critical.touching.empty()
             ? ""
             : fmt::format("; contact with '{}' is stiffer than the grid", critical.touching);
}

std::optional<double> planned_step(const IntegratorDefinition& integrator, const CriticalStep& critical) {
  if (integrator.method != GridMethod::explicit_steps) return integrator.fixed_step;
  return integrator.step ? *integrator.step : *integrator.courant * critical.step;
}

std::string bytes_text(double bytes) {
  return with_unit(bytes,
                   std::array<std::pair<double, const char*>, 6>{
                       {{1.0, "B"}, {1e3, "kB"}, {1e6, "MB"}, {1e9, "GB"}, {1e12, "TB"}, {1e15, "PB"}}});
}

std::string duration_text(double seconds) {
  return with_unit(seconds,
                   std::array<std::pair<double, const char*>, 5>{
                       {{1.0, "s"}, {60.0, "min"}, {3600.0, "h"}, {86400.0, "days"}, {31557600.0, "years"}}});
}

void require_memory(const Scene& scene, const SceneSize& size) {
  const double available = available_memory();
  if (size.memory <= available) return;
  const auto largest = std::max_element(size.particles.begin(), size.particles.end());
  const bool of_factor = size.factor_memory > 0.5 * size.memory;
  throw InputError(fmt::format(
      "{}: found cells of {:g} m, with which the scene has {:.3g} particles (most of them, {:.3g}, in body "
      "'{}') and takes {} of memory{}; available are {}; expected larger cells, fewer particles_per_cell{} "
      "or smaller bodies",
      scene.at("space.cell"), scene.cell, size.all_particles, *largest,
      scene.bodies[static_cast<std::size_t>(largest - size.particles.begin())].name, bytes_text(size.memory),
      of_factor ? fmt::format(", {} of it for a factorised matrix", bytes_text(size.factor_memory)) : "",
      bytes_text(available),
      of_factor ? ", integrator.linear_solver = \"gmres\" with preconditioner = \"diagonal\"," : ""));
}

Work work_of(const Scene& scene, const System& system, int threads) {
  const IntegratorDefinition& integrator = scene.integrator;
  const CriticalStep critical = critical_step_of(integrator, system);
  const std::optional<double> step = planned_step(integrator, critical);
  const double between_outputs = scene.output.every.value_or(scene.end - scene.start);
  const double longest = step.value_or(integrator.method == GridMethod::arkode_implicit
                                           ? integrator.remap.value_or(between_outputs)
                                           : critical.step);
  Work work;
  work.steps = std::max(1.0, std::ceil((scene.end - scene.start) / longest - 1e-6));
  work.is_planned = step.has_value();
  work.evaluations = work.steps * evaluations_of_step(integrator);
  work.seconds =
      work.evaluations * static_cast<double>(system.particle_count()) / (particle_steps_a_second * threads);
  return work;
}

double most_seconds(const Scene& scene, const System& system, const Work& work, int threads) {
  const double increment = (scene.end - scene.start) / work.evaluations;
  return work.seconds + work.evaluations * costliest_evaluation(scene, system, increment) / threads;
}

double output_seconds(const Scene& scene, const System& system) {
  constexpr double of_output = 3e-3, of_particle = 1e-6;
  return outputs_of(scene) * (of_output + of_particle * static_cast<double>(system.particle_count()));
}

void require_time(const Scene& scene, const System& system, const Work& work, int threads) {
  if (work.seconds <= longest_run) return;
  throw InputError(
      fmt::format("{}: found {}{:.3g} steps of {} particles, which take about {} on {} thread{} (at {:g} "
                  "particle-steps a second and thread); expected less than a year: longer steps, larger "
                  "cells, or a nearer time.end",
                  scene.at(step_key(scene.integrator)), work.is_planned ? "" : "at least ", work.steps,
                  system.particle_count(), duration_text(work.seconds), threads, threads == 1 ? "" : "s",
                  particle_steps_a_second));
}

void require_clock(const Scene& scene, const System& system) {
  constexpr double digits = 100.0;  // of the last place, in a step
  const double farthest = std::max(std::abs(scene.start), std::abs(scene.end));
  const double tick = std::nextafter(farthest, HUGE_VAL) - farthest;
  const CriticalStep critical = critical_step_of(scene.integrator, system);
  const double step = planned_step(scene.integrator, critical).value_or(critical.step);
  if (step >= digits * tick) return;
  throw InputError(
      fmt::format("{}: found times up to {:g} s, which are {:.3g} s apart as numbers, and steps of {:.3g} s; "
                  "expected times "
                  "nearer to 0, so that a step is at least {:g} times as long",
                  scene.at(std::abs(scene.start) > std::abs(scene.end) ? "time.start" : "time.end"), farthest,
                  tick, step, digits));
}

double disk_space_of(const Scene& scene, const System& system, bool with_fields) {
  const std::vector<const Material*> materials = output::materials_of(system.bodies);
  const auto particles = static_cast<double>(system.particle_count());
  const auto bodies = static_cast<double>(system.bodies.size());
  // Structure of an output's files; in result.h5 and result.xdmf, a link to it and a row of the series.
  constexpr double of_file = 2500.0, of_dataset = 1300.0, of_drawn_dataset = 600.0, of_door = 400.0;
  double of_output = of_file + of_door, of_checkpoint = 0.0;
  if (with_fields)
    for (const std::string& field : output::select_fields(scene, materials)) {
      const auto components = static_cast<double>(output::components_of(field));
      of_output += of_dataset + bodies * of_drawn_dataset +
                   8.0 * particles * (components + std::ceil(1.5 * components));
    }
  for (const Body& body : system.bodies)
    of_checkpoint += static_cast<double>(body.particles.size) *
                     (4.0 + 8.0 * (13.0 + static_cast<double>(body.material->columns().size())));
  // Of the checkpoint there are two while it is renewed.
  return outputs_of(scene) * of_output + tables_space(scene, system) + 60.0 * particles +
         2.0 * (scene.output.checkpoint_every ? of_checkpoint : 0.0);
}

void require_disk(const Scene& scene, double bytes, const std::filesystem::path& folder) {
  // A disk that is too full for a run of ordinary size is no mistake of the scene's: it may be emptied in
  // time, and a run that meets its end leaves what it has, with a checkpoint where there is room, and
  // status 4.
  constexpr double ordinary = 1e11;
  if (bytes <= ordinary) return;
  double available = available_disk(folder);
  available += size_of_outputs(folder);
  if (bytes <= available) return;
  const double outputs = multiples(scene, scene.output.every) + 2.0;
  throw InputError(fmt::format(
      "{}: found {:.3g} outputs, whose files take {}; available in {} are {}; expected a longer interval, "
      "fewer "
      "output.fields, or --no-fields",
      scene.at("output.every"), outputs, bytes_text(bytes), folder.string(), bytes_text(available)));
}

}  // namespace vitrum::app
