#include "app/run_state.hpp"

#include <fmt/format.h>

#include <cmath>

#include "scene/input_error.hpp"

namespace vitrum::app {
namespace {

/// Walks through everything of a state that is a number, the same way for writing and reading. Counts are far
/// below 2^53.
template <class State, class Visit>
void visit_numbers(State& s, Visit&& visit) {
  auto& e = s.energy;
  visit("energy", e.initial, e.kinetic, e.elastic, e.plastic, e.damage, e.fracture, e.snap_back, e.contact,
        e.friction, e.external, e.max_growth, e.largest_work, e.rounding);
  auto& i = s.integrator;
  visit("integrator", i.segment_start, i.segment_steps, i.segment_done, i.counters.steps, i.counters.rejected,
        i.counters.rhs_evaluations, i.counters.newton_iterations, i.counters.factorisations,
        i.counters.step_min, i.counters.step_max, i.counters.limited_by_stability,
        i.counters.limited_by_accuracy, i.counters.limited_by_output, i.next_step, i.error.position,
        i.error.velocity, i.error.strain, i.error.total, i.remap_loss, i.phases, i.counters.limited_by_remap);
  visit("progress", s.outputs, s.checkpoints, s.energy_times, s.energy_rows, s.energy_step, s.result_steps,
        s.evaluations, s.events, s.last_step, s.wall_seconds, s.earlier_seconds);
  auto& c = s.solver;
  visit("solver", c.increments, c.solves, c.steps, c.right_hand_sides, c.failures);
}

const std::vector<double>& numbers_of(const output::Checkpoint& c, const std::string& name,
                                      std::size_t count) {
  const auto entry = c.numbers.find(name);
  if (entry == c.numbers.end() || entry->second.size() != count)
    throw FileError(fmt::format("checkpoint: '{}' is missing or does not hold {} numbers", name, count));
  return entry->second;
}

void assign(double& to, double value, const std::string&) {
  to = value;
}
/// A count; below 2^53 a double holds it exactly.
void assign(std::int64_t& to, double value, const std::string& name) {
  if (!(value >= 0.0 && value <= 9007199254740992.0 && value == std::floor(value)))
    throw FileError(fmt::format("checkpoint: '{}' holds {}, which is no count", name, value));
  to = static_cast<std::int64_t>(value);
}

struct NamedEvent {
  const char* name;
  std::optional<FirstEvent> FailureAnalysis::Memory::*member;
};
constexpr NamedEvent first_events[] = {{"first_damage", &FailureAnalysis::Memory::damage},
                                       {"first_localisation", &FailureAnalysis::Memory::localisation},
                                       {"first_separation", &FailureAnalysis::Memory::separation}};

}  // namespace

void store(const RunState& state, output::Checkpoint& checkpoint) {
  visit_numbers(state, [&](const char* name, const auto&... values) {
    checkpoint.numbers[name] = {static_cast<double>(values)...};
  });
  checkpoint.numbers["coasting"] = state.coasting;
  checkpoint.numbers["contact"] = state.contact;
  for (std::size_t body = 0; body < state.failure.size(); ++body)
    for (const auto& [event, member] : first_events)
      if (const std::optional<FirstEvent>& first = state.failure[body].*member) {
        const std::string name = fmt::format("{} of body {}", event, body);
        checkpoint.numbers[name] = {first->time, first->r, first->z};
      }
}

RunState restored(const output::Checkpoint& checkpoint) {
  RunState state;
  visit_numbers(state, [&](const std::string& name, auto&... values) {
    const std::vector<double>& numbers = numbers_of(checkpoint, name, sizeof...(values));
    std::size_t k = 0;
    (assign(values, numbers[k++], name), ...);
  });
  state.coasting = numbers_of(checkpoint, "coasting", checkpoint.bodies.size());
  if (const auto contact = checkpoint.numbers.find("contact"); contact != checkpoint.numbers.end())
    state.contact = contact->second;
  state.failure.resize(checkpoint.bodies.size());
  for (std::size_t body = 0; body < state.failure.size(); ++body)
    for (const auto& [event, member] : first_events) {
      const std::string name = fmt::format("{} of body {}", event, body);
      if (!checkpoint.numbers.contains(name)) continue;
      const std::vector<double>& n = numbers_of(checkpoint, name, 3);
      state.failure[body].*member = FirstEvent{n[0], n[1], n[2], checkpoint.bodies[body].name};
    }
  return state;
}

}  // namespace vitrum::app
