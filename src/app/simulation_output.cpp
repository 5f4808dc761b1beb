#include <fmt/format.h>

#include <iterator>
#include <limits>

#include "app/simulation.hpp"
#include "mpm/contact/contact.hpp"
#include "mpm/removal.hpp"
#include "observe/fragments.hpp"
#include "output/particle_fields.hpp"
#include "scene/input_error.hpp"
#include "scene/write_scene.hpp"

namespace vitrum::app {

std::vector<Quantity> Simulation::series() const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const ErrorEstimate& error = integrator_->state().error;
  const auto estimated = [&](double sum) { return integrator_->estimates_errors() ? sum : none; };
  const char* unit = system_.axisymmetric ? "J" : "J/m";
  std::vector<Quantity> all = observers_.quantities(system_);
  const Quantity of_integrator[] = {
      {"step_size", "s", "last step", state_.last_step},
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
  all.insert(all.end(), std::begin(of_integrator), std::end(of_integrator));
  return all;
}

void Simulation::require_folder() {
  if (!folder_.holds())
    throw FileError(
        fmt::format("{}: is no longer this run's folder: it was moved, removed, cleared or taken by "
                    "another run",
                    directory_.string()));
}

void Simulation::write_output() {
  require_folder();
  observers_.tell_output(system_);
  tables_.write_all();
  output::OutputFrame frame{system_.time, system_.step_index, {}, series(), {}};
  if (!fields_.empty()) {
    frame.fields = output::particle_fields(system_.bodies, fields_, scene_.geometry);
    frame.fragment = output::in_rows(system_.bodies, piece_numbers(system_));
  }
  result_->append(frame);
  state_.result_steps = static_cast<std::int64_t>(result_->outputs());
  progress_.output(system_.time, integrator_->state().counters, shown_energy());
}

void Simulation::write_checkpoint() {
  require_folder();
  result_->settle();  // what the checkpoint knows of shall be there whenever it is
  output::Checkpoint checkpoint{system_.time,
                                system_.step_index,
                                provenance_.scene_sha256,
                                output::checkpoint_bodies(system_.bodies),
                                {}};
  state_.integrator = integrator_->state();
  state_.evaluations = system_.constitutive_evaluations;
  state_.events = system_.constitutive_events;
  state_.solver = system_.constitutive_solver;
  state_.coasting.clear();
  for (const Body& body : system_.bodies) state_.coasting.push_back(body.coasting ? 1.0 : 0.0);
  state_.removed = mpm::removed_counts(system_);
  if (system_.contact) state_.contact = system_.contact->state(system_);
  RunState stored = state_;
  stored.earlier_seconds = total_seconds();
  save(stored, checkpoint.state);
  observers_.save(checkpoint.state);
  tables_.save(checkpoint.state);
  checkpoint.state.put_text("scene", resolved_toml(scene_));
  checkpoint.state.put_text("command", resuming_command(options_));
  output::write_checkpoint(directory_ / "checkpoint.h5", checkpoint);
}

}  // namespace vitrum::app
