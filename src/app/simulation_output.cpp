#include <fmt/format.h>

#include <limits>

#include "analysis/fragments.hpp"
#include "app/simulation.hpp"
#include "mpm/contact/contact.hpp"
#include "output/particle_fields.hpp"
#include "scene/input_error.hpp"
#include "scene/write_scene.hpp"

namespace vitrum::app {

void Simulation::write_energy_row() {
  if (state_.energy_rows > 0 && state_.energy_step == system_.step_index) return;
  energy_csv_->append(system_.time, system_.step_index, shown_energy());
  state_.energy_rows = static_cast<std::int64_t>(energy_csv_->rows());
  state_.energy_step = system_.step_index;
}

void Simulation::write_due_energy_row() {
  if (system_.time < schedule_.energy_row(state_.energy_times)) return;
  write_energy_row();
  while (system_.time >= schedule_.energy_row(state_.energy_times)) ++state_.energy_times;
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
      {"contact", unit, "energy stored between bodies", e.contact},
      {"friction", unit, "energy dissipated by friction between bodies", e.friction},
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
  if (system_.contact) state_.contact = system_.contact->state();
  RunState stored = state_;
  stored.earlier_seconds = total_seconds();
  store(stored, checkpoint);
  checkpoint.texts = {{"scene", resolved_toml(scene_)}, {"command", resuming_command(options_)}};
  output::write_checkpoint(directory_ / "checkpoint.h5", checkpoint);
}

}  // namespace vitrum::app
