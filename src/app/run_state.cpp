#include "app/run_state.hpp"

namespace vitrum::app {
namespace {

/// Calls visit(name, number) for each number of a state, the same for writing and reading.
template <class State, class Visit>
void visit_numbers(State& s, Visit&& visit) {
  auto& i = s.integrator;
  visit("integrator.segment_start", i.segment_start);
  visit("integrator.segment_steps", i.segment_steps);
  visit("integrator.segment_done", i.segment_done);
  visit("integrator.next_step", i.next_step);
  visit("integrator.error_position", i.error.position);
  visit("integrator.error_velocity", i.error.velocity);
  visit("integrator.error_strain", i.error.strain);
  visit("integrator.error_total", i.error.total);
  visit("integrator.remap_loss", i.remap_loss);
  visit("integrator.phases", i.phases);
  auto& c = i.counters;
  visit("integrator.steps", c.steps);
  visit("integrator.rejected", c.rejected);
  visit("integrator.rhs_evaluations", c.rhs_evaluations);
  visit("integrator.newton_iterations", c.newton_iterations);
  visit("integrator.factorisations", c.factorisations);
  visit("integrator.factor_entries", c.factor_entries);
  visit("integrator.step_min", c.step_min);
  visit("integrator.step_max", c.step_max);
  visit("integrator.limited_by_stability", c.limited_by_stability);
  visit("integrator.limited_by_contact", c.limited_by_contact);
  visit("integrator.limited_by_accuracy", c.limited_by_accuracy);
  visit("integrator.limited_by_output", c.limited_by_output);
  visit("integrator.limited_by_remap", c.limited_by_remap);
  visit("run.outputs", s.outputs);
  visit("run.checkpoints", s.checkpoints);
  visit("run.result_steps", s.result_steps);
  visit("run.last_step", s.last_step);
  visit("run.wall_seconds", s.wall_seconds);
  visit("run.earlier_seconds", s.earlier_seconds);
  visit("constitutive.evaluations", s.evaluations);
  visit("constitutive.events", s.events);
  auto& v = s.solver;
  visit("constitutive.increments", v.increments);
  visit("constitutive.solves", v.solves);
  visit("constitutive.steps", v.steps);
  visit("constitutive.right_hand_sides", v.right_hand_sides);
  visit("constitutive.failures", v.failures);
}

void take(const Archive& archive, const char* name, double& to) {
  to = archive.number(name);
}
void take(const Archive& archive, const char* name, std::int64_t& to) {
  to = archive.count(name);
}

constexpr const char *coasting = "run.coasting", *contact = "run.contact", *removed = "run.removed";

}  // namespace

void save(const RunState& state, Archive& archive) {
  visit_numbers(state,
                [&](const char* name, const auto& value) { archive.put(name, static_cast<double>(value)); });
  archive.put(coasting, state.coasting);
  archive.put(contact, state.contact);
  if (!state.removed.empty()) archive.put(removed, state.removed);
}

RunState restored(const Archive& archive, std::size_t bodies) {
  RunState state;
  visit_numbers(state, [&](const char* name, auto& value) { take(archive, name, value); });
  state.coasting = archive.numbers(coasting, bodies);
  state.contact = archive.numbers(contact);
  if (archive.has(removed)) state.removed = archive.numbers(removed);
  return state;
}

}  // namespace vitrum::app
