#include "integrators/local/path_follower.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/composite/evolution.hpp"
#include "materials/root.hpp"

namespace vitrum {
namespace {

bool is_finite(const SymmetricTensor& a) {
  return std::isfinite(a.rr + a.zz + a.tt + a.rz);
}

/// The state of a mode without curved evolution, `fraction` further along the path.
CompositeState along(const CompositeState& start, const EvolutionRates& r, double fraction) {
  CompositeState s = start;
  s.elastic_strain += fraction * r.elastic_strain;
  s.opening_n += fraction * r.opening_n;
  s.opening_t += fraction * r.opening_t;
  return s;
}

/// Moves the state to the first event of a straight mode, or to the end of the path; `done` is the fraction
/// reached.
std::optional<Root> follow_straight(const EventDriven& material, const EvolutionMode& mode,
                                    const StrainPath& path, CompositeState& state, double& done) {
  const EvolutionRates r = material.rates(mode, state, path);
  const double left = 1.0 - done;
  EventFunctions before, functions;
  material.events(mode, along(state, r, left), path, functions);
  std::optional<Root> first;
  double taken = left;
  EventFunctions inside;
  for (std::size_t k = 0; k < functions.count; ++k) {
    if (!(functions.value[k] > 0.0)) continue;
    // The error of what came before may have left a function above zero: it is no event until it rises. (On a
    // path that stands still nothing does, however often the mode would change and change back.)
    if (before.count == 0) material.events(mode, state, path, before);
    const double reached = std::max(0.0, before.value[k]);
    if (!(functions.value[k] > reached)) continue;
    // (The event functions of straight modes are convex along the path: what is below zero at its end never
    // crossed.)
    const double at = first_reached(0.0, left, [&](double f) {
      material.events(mode, along(state, r, f), path, inside);
      return inside.value[k] > reached;
    });
    if (!first || at < taken) first = functions.root[k], taken = at;
  }
  state = along(state, r, taken);
  done = first ? done + taken : 1.0;
  return first;
}

}  // namespace

void PathFollower::integrate(const Material& door, PointState& point, const SymmetricTensor& strain,
                             double duration, PointReport& report) {
  if (door.event_driven() == nullptr) {
    door.advance(point, strain, duration, report);
    return;
  }
  const EventDriven& material = *door.event_driven();
  CompositeState state = material.load(point);
  if (!is_finite(strain) || !is_finite(state.elastic_strain) || !(duration >= 0.0)) {
    report.cause = "the strain or its increment is not finite";
    return;
  }
  constexpr int most_events = 2000;  // (shear released at zero mean strain may chatter some hundred times)
  constexpr std::int64_t most_steps = 500'000;  // of the solver, in all modes: about a second
  const std::int64_t steps_before = report.solver.steps;
  const StrainPath path{strain, duration, tolerance_.relative};
  const double dissipated_before = report.dissipation.total();
  double done = 0.0;
  bool needs_solver = false;
  EvolutionMode mode = material.enter(state, path, report);
  for (int events = 0; done < 1.0; ++events) {
    if (events == most_events) {
      report.cause = fmt::format("more than {} changes of mode in one increment", most_events);
      return;
    }
    std::optional<Root> root;
    if (!mode.evolves()) {
      root = follow_straight(material, mode, path, state, done);
      if (!root) break;
    } else {
      needs_solver = true;
      const ModeProblem problem(material, mode, path, state, done);
      std::array<double, ModeProblem::capacity> y{};
      problem.initial(y.data());
      Stop stop;
      ++report.solver.solves;
      if (!solve(problem, y.data(), stop, report)) return;
      if (report.solver.steps - steps_before > most_steps) {
        report.cause = fmt::format("more than {} solver steps in one increment", most_steps);
        return;
      }
      for (std::size_t i = 0; i < problem.size(); ++i)
        if (!std::isfinite(y[i])) {
          report.cause = fmt::format("the {} is not finite", problem.name(i));
          return;
        }
      report.dissipation += problem.dissipation(y.data());
      done = problem.fraction(stop.parameter, y.data());
      CompositeState next = problem.state(stop.parameter, y.data());
      state = next;
      material.settle(mode, state, path);
      root = stop.root;
      if (root == Root::path_end) break;
      if (!root) continue;
    }
    done = std::min(done, 1.0);
    material.leave(mode, *root, state, path, done, report);
  }
  if (needs_solver) ++report.solver.increments;
  state.stress = material.secant_moduli(state).stress(state.elastic_strain);
  state.dissipated += report.dissipation.total() - dissipated_before;
  material.store(state, point);
  if (!is_finite(state.stress) || !std::isfinite(state.dissipated + state.opening_n + state.opening_t))
    report.cause = "the stress, the opening or the dissipation is not finite";
}

}  // namespace vitrum
