#include "app/simulation.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <new>
#include <numbers>

#include "app/command_line.hpp"
#include "app/failed_point.hpp"
#include "app/signals.hpp"
#include "mpm/coasting.hpp"
#include "mpm/computation_error.hpp"
#include "output/atomic_file.hpp"
#include "output/particle_fields.hpp"
#include "output/sha256.hpp"
#include "output/xdmf.hpp"
#include "scene/grid_method.hpp"
#include "scene/input_error.hpp"
#include "scene/write_scene.hpp"

namespace vitrum::app {

Simulation::Simulation(const Scene& scene, System system, const RunOptions& options,
                       std::filesystem::path directory)
    : scene_(scene),
      options_(options),
      directory_(std::move(directory)),
      system_(std::move(system)),
      whole_(system_.axisymmetric ? 2.0 * std::numbers::pi : 1.0),
      integrator_(make_grid_integrator(scene.integrator, system_)),
      ledger_(system_),
      failure_(system_),
      watchdog_(scene.integrator.max_growth, *integrator_),
      schedule_(scene),
      progress_(scene.start, scene.end, system_.axisymmetric ? "J" : "J/m", options.quiet) {
  const std::vector<const Material*> materials = output::materials_of(system_.bodies);
  fields_ = output::select_fields(scene.output.fields, materials);
  if (options_.no_fields) fields_.clear();
  provenance_ = output::make_provenance(options.command, output::sha256(resolved_toml(scene)));
  catch_signals();
  options.resume ? resume() : start();
}

void Simulation::start() {
  // What an earlier run left here would speak for this one.
  for (const char* name : {"summary.json", "checkpoint.h5", "result.xdmf"}) {
    std::error_code error;
    std::filesystem::remove(directory_ / name, error);
    if (error)
      throw FileError(
          fmt::format("{}: cannot be removed: {}", (directory_ / name).string(), error.message()));
  }
  result_ = output::ResultFile::create(
      directory_, {scene_.title, scene_.verbatim, resolved_toml(scene_), provenance_,
                   options_.no_fields ? output::ParticleConstants{}
                                      : output::particle_constants(system_.bodies, scene_.geometry)});
  energy_csv_ = output::EnergyCsv::create(directory_ / "energy.csv");
  write_energy_row();
  ++state_.energy_times;
  if (schedule_.output_at_start()) write_output();
}

void Simulation::resume() {
  const output::Checkpoint checkpoint = output::read_checkpoint(directory_ / "checkpoint.h5");
  if (checkpoint.scene_sha256 != provenance_.scene_sha256)
    throw InputError(fmt::format(
        "{}: found a checkpoint of another scene (or other --set values); expected the one of this scene",
        (directory_ / "checkpoint.h5").string()));
  output::restore_bodies(checkpoint, system_.bodies);
  state_ = restored(checkpoint);
  system_.time = checkpoint.time;
  system_.step_index = checkpoint.step_index;
  system_.constitutive_evaluations = state_.evaluations;
  system_.constitutive_events = state_.events;
  system_.constitutive_solver = state_.solver;
  mpm::restore_coasting(system_, state_.coasting);
  ledger_ = EnergyLedger(system_, state_.energy);
  failure_.restore(state_.failure);
  integrator_->restore(state_.integrator);
  result_ = output::ResultFile::reopen(directory_, static_cast<std::size_t>(state_.result_steps));
  if ((result_->particles() == 0) != options_.no_fields)
    throw InputError(fmt::format("--resume: found a run {} particle data in {}, expected {} --no-fields",
                                 options_.no_fields ? "with" : "without", directory_.string(),
                                 options_.no_fields ? "no" : "also"));
  energy_csv_ =
      output::EnergyCsv::reopen(directory_ / "energy.csv", static_cast<std::size_t>(state_.energy_rows));
}

int Simulation::run() {
  while (!ended()) {
    const Schedule::Target target = schedule_.next(state_.outputs, state_.checkpoints);
    const bool reached = advance_to(target.time);
    if (failed_) return finish(output::RunStatus::failed, *failed_, exit_computation);
    if (reached) {
      if (target.output) {
        ++state_.outputs;
        write_output();
      }
      if (target.checkpoint) {
        ++state_.checkpoints;
        write_checkpoint();
      }
    }
    if (ended()) break;
    if (const int signal = caught_signal()) {
      write_checkpoint();
      return finish(output::RunStatus::interrupted,
                    fmt::format("signal {}: checkpoint written at t = {:.6e} s; continue with the same "
                                "command and --resume, folder {}",
                                signal, system_.time, directory_.string()),
                    128 + signal);
    }
  }
  return finish(output::RunStatus::complete, "", exit_done);
}

bool Simulation::ended() const {
  // Not just the time: a run interrupted by its last step, and resumed, still has to write.
  return !result_->steps().empty() && result_->steps().back().time >= scene_.end;
}

bool Simulation::advance_to(double target) {
  const auto begun = std::chrono::steady_clock::now();
  bool reached = false;
  try {
    reached = integrator_->advance(system_, target, *this);
  } catch (const PointFailure& error) {
    const std::filesystem::path file = directory_ / "failed_point.toml";
    output::write_text_atomically(file, failed_point(scene_, system_, error));
    failed_ = fmt::format("t = {:.6e} s: {}; `vitrum point {}` replays it", system_.time, error.what(),
                          file.string());
  } catch (const ComputationError& error) {
    failed_ = Watchdog::describe(system_, error.what());
  } catch (const std::bad_alloc&) {
    failed_ = Watchdog::describe(
        system_, "out of memory; reduce the number of particles (space.cell, particles_per_cell)");
  }
  if (scene_.integrator.method == GridMethod::arkode_implicit && (failed_ || !reached))
    ledger_.refresh_kinetic(system_);
  state_.wall_seconds += std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count();
  return reached;
}

bool Simulation::step_done(System& system, double step) {
  last_step_ = step;
  ledger_.book(system);
  failure_.observe(system, step);
  failed_ = watchdog_.look(system, ledger_, step);
  if (failed_) return false;
  if (system.time >= schedule_.energy_row(state_.energy_times)) {
    write_energy_row();
    while (system.time >= schedule_.energy_row(state_.energy_times)) ++state_.energy_times;
  }
  progress_.step(system.time, step, integrator_->state().counters);
  return caught_signal() == 0;
}

void Simulation::write_energy_row() {
  if (state_.energy_rows > 0 && state_.energy_step == system_.step_index) return;
  energy_csv_->append(system_.time, system_.step_index, shown_energy());
  state_.energy_rows = static_cast<std::int64_t>(energy_csv_->rows());
  state_.energy_step = system_.step_index;
}

std::vector<output::SeriesValue> Simulation::series() const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const EnergyTotals e = shown_energy();
  const FailureReport f = failure_.report(system_, false);
  const ErrorEstimate& error = integrator_->state().error;
  const auto estimated = [&](double sum) { return integrator_->estimates_errors() ? sum : none; };
  const char* unit = system_.axisymmetric ? "J" : "J/m";
  return {
      {"kinetic", unit, "kinetic energy", e.kinetic},
      {"elastic", unit, "stored elastic energy", e.elastic},
      {"plastic", unit, "energy dissipated by plastic flow", e.plastic},
      {"damage", unit, "energy dissipated by damage", e.damage},
      {"fracture", unit, "energy dissipated by decohesion", e.fracture},
      {"external", unit, "work of gravity and prescribed velocities", e.external},
      {"residual", unit, "initial + external - all of the above: what the numerics made", e.residual()},
      {"max_growth", "1", "largest (kinetic + elastic) / initial so far", e.max_growth},
      {"localised", "1", "localised particles", static_cast<double>(f.localised)},
      {"separated", "1", "separated particles", static_cast<double>(f.separated)},
      {"localised_radius_max", "m", "largest r (|x|) of a localised particle; NaN: none",
       f.localised_radius_max.value_or(none)},
      {"damage_front_radius", "m", "largest r (|x|) with damage above 0.1; NaN: none",
       f.damage_front_radius.value_or(none)},
      {"max_opening", "m", "largest opening; NaN: none", f.max_opening.value_or(none)},
      {"step_size", "s", "last step", last_step_},
      {"error_estimate", "1",
       "accumulated local error estimates of all unknowns (root mean square, relative to their scales, "
       "summed over "
       "the steps); NaN: the method makes none",
       estimated(error.total)},
      {"error_position", "1", "the same of positions (nodal displacements), relative to the cell",
       estimated(error.position)},
      {"error_velocity", "1", "the same of velocities, relative to the scene's velocity scale",
       estimated(error.velocity)},
      {"error_strain", "1", "the same of particle strains, relative to the scene's strain scale",
       estimated(error.strain)},
      {"remap_loss", unit,
       "kinetic energy lost so far between grid and particles at remaps (arkode-implicit)",
       whole_ * integrator_->state().remap_loss},
      {"phases", "1", "Lagrangian phases so far (arkode-implicit)",
       static_cast<double>(integrator_->state().phases)},
  };
}

void Simulation::write_output() {
  output::OutputFrame frame{system_.time, system_.step_index, {}, series()};
  if (!fields_.empty()) frame.fields = output::particle_fields(system_.bodies, fields_, scene_.geometry);
  result_->append(frame);
  if (!fields_.empty()) output::write_xdmf(*result_);
  state_.result_steps = static_cast<std::int64_t>(result_->steps().size());
  progress_.output(system_.time, integrator_->state().counters, shown_energy());
}

void Simulation::write_checkpoint() {
  output::Checkpoint checkpoint{system_.time,
                                system_.step_index,
                                provenance_.scene_sha256,
                                output::checkpoint_bodies(system_.bodies),
                                {},
                                {}};
  state_.energy = ledger_.totals();
  state_.failure = failure_.memory();
  state_.integrator = integrator_->state();
  state_.evaluations = system_.constitutive_evaluations;
  state_.events = system_.constitutive_events;
  state_.solver = system_.constitutive_solver;
  state_.coasting.clear();
  for (const Body& body : system_.bodies) state_.coasting.push_back(body.coasting ? 1.0 : 0.0);
  store(state_, checkpoint);
  output::write_checkpoint(directory_ / "checkpoint.h5", checkpoint);
}

}  // namespace vitrum::app
