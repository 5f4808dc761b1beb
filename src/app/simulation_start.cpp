#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "app/simulation.hpp"
#include "mpm/coasting.hpp"
#include "mpm/contact/contact.hpp"
#include "mpm/initial_state.hpp"
#include "mpm/removal.hpp"
#include "output/atomic_file.hpp"
#include "output/particle_fields.hpp"
#include "scene/input_error.hpp"
#include "scene/scene_differences.hpp"
#include "scene/write_scene.hpp"

namespace vitrum::app {

void Simulation::start() {
  mpm::judge_initial_states(system_);
  observers_.step(system_, 0.0);
  tables_.create();
  tables_.write_all();
  tables_.store();  // before the door that leads to it
  result_ = output::ResultFile::create(
      directory_, {scene_.title, scene_.verbatim, resolved_toml(scene_), provenance_,
                   options_.no_fields ? output::ParticleConstants{}
                                      : output::particle_constants(system_.bodies, scene_.geometry)});
  if (schedule_.output_at_start()) write_output();
}

/// A command line says all that it computes: what a run was told by --set is not taken from its checkpoint.
void Simulation::refuse_scene(const output::Checkpoint& checkpoint) const {
  constexpr std::size_t shown = 3;
  const std::vector<std::string> all =
      scene_differences(resolved_toml(scene_), checkpoint.state.text("scene"));
  const std::vector<std::string> first(all.begin(), all.begin() + std::min(shown, all.size()));
  throw InputError(
      fmt::format("{}: found a checkpoint of another scene or of other --set values: {}{}; expected those of "
                  "the run that "
                  "it continues: `{}`",
                  (directory_ / "checkpoint.h5").string(), fmt::join(first, "; "),
                  all.size() > shown ? fmt::format("; and {} keys more", all.size() - shown) : "",
                  checkpoint.state.text("command")));
}

void Simulation::resume() {
  const output::Checkpoint checkpoint = output::read_checkpoint(directory_ / "checkpoint.h5");
  if (checkpoint.scene_sha256 != provenance_.scene_sha256) refuse_scene(checkpoint);
  output::restore_bodies(checkpoint, system_.bodies);
  state_ = restored(checkpoint.state, system_.bodies.size());
  system_.time = checkpoint.time;
  system_.step_index = checkpoint.step_index;
  system_.constitutive_evaluations = state_.evaluations;
  system_.constitutive_events = state_.events;
  system_.constitutive_solver = state_.solver;
  if (!mpm::restore_removed(system_, state_.removed))
    throw FileError("checkpoint: 'run.removed' does not fit this scene");
  mpm::restore_coasting(system_, state_.coasting);
  if (system_.contact && !system_.contact->restore(system_, state_.contact))
    throw FileError("checkpoint: 'run.contact' does not fit this scene");
  observers_.restore(checkpoint.state);
  integrator_->restore(state_.integrator);
  result_ = output::ResultFile::reopen(directory_, static_cast<std::size_t>(state_.result_steps));
  if ((result_->particles() == 0) != options_.no_fields)
    throw InputError(fmt::format("--resume: found a run {} particle data in {}, expected {} --no-fields",
                                 options_.no_fields ? "with" : "without", directory_.string(),
                                 options_.no_fields ? "no" : "also"));
  tables_.reopen(checkpoint.state);
  // What the run left when it was interrupted would speak for what follows.
  output::remove_file(directory_ / "summary.json");
  tables_.store();
  tables_.write_all();  // a run that could not write them ends with a checkpoint all the same
}

}  // namespace vitrum::app
