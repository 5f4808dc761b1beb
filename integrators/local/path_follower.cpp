#include "integrators/local/path_follower.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "materials/root.hpp"

namespace vitrum {
namespace {

bool is_finite(const SymmetricTensor& a) {
  return std::isfinite(a.rr + a.zz + a.tt + a.rz);
}

/// Whether stress, dissipation and what the material stores are finite.
bool is_finite(const Material& material, const PointState& s) {
  double sum = s.dissipated;
  for (std::size_t k = 0, count = material.columns().size(); k < count; ++k) sum += s.variables[k];
  return is_finite(s.stress) && std::isfinite(sum);
}

/// Moves a course in a straight mode to its first event, or to the end of the path; `done` is the fraction
/// reached.
std::optional<Guard> follow_straight(Course& course, double& done) {
  const double left = 1.0 - done;
  Guards before, at_end, inside;
  course.guards_ahead(left, at_end);
  std::optional<Guard> first;
  double taken = left;
  for (std::size_t k = 0; k < at_end.count; ++k) {
    if (!(at_end.value[k] > 0.0)) continue;
    // The error of what came before may have left a guard above zero: it is no event until it rises. (On a
    // path that stands still nothing does, however often the mode would change and change back.)
    if (before.count == 0) course.guards_ahead(0.0, before);
    const double reached = std::max(0.0, before.value[k]);
    if (!(at_end.value[k] > reached)) continue;
    // (The guards of straight modes are convex along the path: what is below zero at its end never crossed.)
    const double at = first_reached(0.0, left, [&](double f) {
      course.guards_ahead(f, inside);
      return inside.value[k] > reached;
    });
    if (!first || at < taken) first = at_end.guard[k], taken = at;
  }
  course.move(taken);
  done = first ? done + taken : 1.0;
  return first;
}

}  // namespace

void PathFollower::integrate(const Material& material, PointState& state, const SymmetricTensor& strain,
                             double duration, PointReport& report) {
  const EventDriven* law = material.event_driven();
  if (law == nullptr) {
    material.advance(state, strain, duration, report);
    return;
  }
  if (!is_finite(strain) || !is_finite(state.elastic_strain) || !(duration >= 0.0)) {
    report.cause = "the strain or its increment is not finite";
    return;
  }
  const StrainPath path{strain, duration, tolerance_.relative};
  const double dissipated_before = report.dissipation.total();
  CourseRoom room;
  Course& course = law->enter(room, state, path, report);
  if (!follow(course, report)) return;
  course.put(state);
  state.dissipated += report.dissipation.total() - dissipated_before;
  if (!is_finite(material, state)) report.cause = "the stress, a variable or the dissipation is not finite";
}

/// Takes a course to the end of its path. False: report.cause says why not.
bool PathFollower::follow(Course& course, PointReport& report) {
  constexpr int most_events = 2000;  // (shear released at zero mean strain may chatter some hundred times)
  constexpr std::int64_t most_steps = 500'000;  // of the solver, in all modes: about a second
  const std::int64_t steps_before = report.solver.steps;
  double done = 0.0;
  bool needs_solver = false;
  for (int events = 0; done < 1.0; ++events) {
    if (events == most_events) {
      report.cause = fmt::format("more than {} changes of mode in one increment", most_events);
      return false;
    }
    std::optional<Guard> guard;
    if (!course.evolves()) {
      guard = follow_straight(course, done);
      if (!guard) break;
    } else {
      needs_solver = true;
      const ModeEquations& equations = course.equations(done);
      std::array<double, ModeEquations::most_unknowns> y{};
      equations.initial(y.data());
      Stop stop;
      ++report.solver.solves;
      if (!solve(equations, y.data(), stop, report)) return false;
      if (report.solver.steps - steps_before > most_steps) {
        report.cause = fmt::format("more than {} solver steps in one increment", most_steps);
        return false;
      }
      for (std::size_t i = 0; i < equations.size(); ++i)
        if (!std::isfinite(y[i])) {
          report.cause = fmt::format("the {} is not finite", equations.name(i));
          return false;
        }
      done = course.follow(stop.parameter, y.data(), report.dissipation);
      guard = stop.guard;
      if (guard == path_end) break;
      if (!guard) continue;
    }
    done = std::min(done, 1.0);
    course.transition(*guard, done, report);
  }
  if (needs_solver) ++report.solver.increments;
  return true;
}

}  // namespace vitrum
