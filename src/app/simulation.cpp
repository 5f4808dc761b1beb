#include "app/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <new>
#include <numbers>

#include "app/command_line.hpp"
#include "app/failed_point.hpp"
#include "app/messages.hpp"
#include "app/signals.hpp"
#include "integrators/grid/grid_method.hpp"
#include "output/atomic_file.hpp"
#include "output/particle_fields.hpp"
#include "scene/input_error.hpp"
#include "scene/sha256.hpp"
#include "scene/write_scene.hpp"

namespace vitrum::app {

Simulation::Simulation(const Scene& scene, System system, const RunOptions& options,
                       output::FolderLock folder, Warnings warned)
    : scene_(scene),
      options_(options),
      folder_(std::move(folder)),
      directory_(folder_.folder()),
      system_(std::move(system)),
      whole_(system_.axisymmetric ? 2.0 * std::numbers::pi : 1.0),
      integrator_(make_grid_integrator(scene.integrator, system_)),
      observers_(scene, system_),
      ledger_(observers_.get<EnergyLedger>()),
      failure_(observers_.get<FailureAnalysis>()),
      watchdog_(scene.integrator.max_growth, *integrator_),
      schedule_(scene),
      progress_(scene.start, scene.end, system_.axisymmetric ? "J" : "J/m", options.quiet),
      tables_(directory_, observers_.tables(), !system_.axisymmetric),
      warned_(std::move(warned)) {
  const std::vector<const Material*> materials = output::materials_of(system_.bodies);
  fields_ = output::select_fields(scene, materials);
  if (options_.no_fields) fields_.clear();
  provenance_ = output::make_provenance(options.command, sha256(resolved_toml(scene)));
  catch_signals();
  options.resume ? resume() : start();
}

int Simulation::run() {
  try {
    return run_to_end();
  } catch (const FileError& error) {
    return give_up(error.what());
  }
}

int Simulation::run_to_end() {
  progress_.begin(system_.time);
  while (!ended()) {
    const Schedule::Target target = schedule_.next(state_.outputs, state_.checkpoints);
    const bool reached = advance_to(target.time);
    if (failed_) return finish(output::RunStatus::failed, *failed_, exit_computation);
    if (unwritten_) throw FileError(*unwritten_);
    if (reached) {
      if (target.output) {
        write_output();
        ++state_.outputs;
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
                    fmt::format("signal {}: checkpoint written at t = {:.6e} s; continue with `{}`", signal,
                                system_.time, resuming_command(options_)),
                    128 + signal);
    }
  }
  return finish(output::RunStatus::complete, "", exit_done);
}

/// Something could not be written. All that was computed so far is in memory: a checkpoint may still find
/// room where an output did not.
int Simulation::give_up(const std::string& cause) {
  std::string message = fmt::format("t = {:.6e} s: {}", system_.time, cause);
  try {
    write_checkpoint();
    message += fmt::format("; checkpoint written: when the cause is mended, continue with `{}`",
                           resuming_command(options_));
  } catch (const FileError& error) {
    message += fmt::format("; nor could a checkpoint be written: {}", error.what());
  }
  return conclude(output::RunStatus::failed, message, exit_file);
}

bool Simulation::ended() const {
  // Not just the time: a run interrupted by its last step, and resumed, still has to write.
  return result_->outputs() > 0 && result_->last_time() >= scene_.end;
}

bool Simulation::advance_to(double target) {
  if (system_.time >= target) return true;  // resumed where an output could not be written
  const auto begun = std::chrono::steady_clock::now();
  bool reached = false;
  try {
    reached = integrator_->advance(system_, target, *this);
  } catch (const PointFailure& error) {
    failed_ = fmt::format("t = {:.6e} s: {}; {}", system_.time, error.what(), keep_failed_point(error));
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

/// Writes the increment that failed to a file; says what to do with it.
std::string Simulation::keep_failed_point(const PointFailure& failure) {
  const std::filesystem::path file = directory_ / "failed_point.toml";
  try {
    require_folder();
    output::write_text_atomically(file, failed_point(scene_, system_, failure));
    return fmt::format("`vitrum point {}` replays it", shell_quoted(file.string()));
  } catch (const FileError& error) {
    return fmt::format("it could not be kept for a replay: {}", error.what());
  }
}

bool Simulation::step_done(System& system, double step) {
  state_.last_step = step;
  observers_.step(system, step);
  std::ranges::fill(system.record.impulses, 0.0);
  failed_ = watchdog_.look(system, ledger_, step);
  if (failed_) return false;
  try {
    tables_.write_due();
  } catch (const FileError& error) {
    unwritten_ = error.what();  // the integrator must be left in order
    return false;
  }
  if (progress_.is_due()) progress_.draw(system.time, step, integrator_->state().counters, shown_energy());
  return caught_signal() == 0;
}

}  // namespace vitrum::app
