#pragma once
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/composite_material.hpp"
#include "support/random_states.hpp"

namespace vitrum::test {

/// A straight piece of a strain path.
struct Segment {
  SymmetricTensor strain;
  double duration;  // s
};

struct TimedEvent {
  EventKind kind;
  double time;
};

/// What following a path left behind. `work` is the integral of stress : d strain, J/m^3, by the rule of
/// `drive`.
struct Driven {
  CompositeState state;
  std::vector<TimedEvent> events;
  Dissipation dissipation;
  double work = 0.0;
  double least_dissipation = 0.0;  ///< smallest total of one increment, J/m^3
  std::string cause = {};          ///< of a failure
  SolverCounters solver = {};

  double time_of(EventKind kind) const {  // -1 when it did not happen
    for (const TimedEvent& e : events)
      if (e.kind == kind) return e.time;
    return -1.0;
  }
  long count(EventKind kind) const {
    return std::count_if(events.begin(), events.end(), [&](const TimedEvent& e) { return e.kind == kind; });
  }
};

/// Follows `path` with `steps` equal increments a segment; the trapezoidal rule gives the work.
/// integrator: null for the closed form. A failed increment ends the path; `cause` tells why.
inline Driven drive(const CompositeMaterial& material, const std::vector<Segment>& path, int steps,
                    CompositeState start = {}, PointIntegrator* integrator = nullptr) {
  Driven d;
  d.state = start;
  double time = 0.0;
  for (const Segment& segment : path) {
    const double duration = segment.duration / steps;
    const SymmetricTensor strain = (1.0 / steps) * segment.strain;
    for (int i = 0; i < steps; ++i) {
      const SymmetricTensor before = d.state.stress;
      PointReport report;
      if (integrator == nullptr)
        material.respond(d.state, strain, duration, report);
      else
        material.integrate(*integrator, d.state, strain, duration, report);
      if (report.failed()) {
        d.cause = report.cause;
        return d;
      }
      d.solver += report.solver;
      for (std::size_t k = 0; k < report.events.size(); ++k)
        d.events.push_back({report.events[k].kind, time + duration * report.events[k].fraction});
      d.dissipation += report.dissipation;
      d.least_dissipation = std::min(d.least_dissipation, report.dissipation.total());
      d.work += 0.5 * contract(before + d.state.stress, strain);
      time += duration;
    }
  }
  return d;
}

inline bool is_finite(const SymmetricTensor& a) {
  return std::isfinite(a.rr) && std::isfinite(a.zz) && std::isfinite(a.tt) && std::isfinite(a.rz);
}
inline bool is_finite(const CompositeState& s) {
  bool finite = is_finite(s.elastic_strain) && is_finite(s.stress);
  for (const std::string_view name : number_names) finite = finite && std::isfinite(number(s, name));
  return finite;
}
inline double distance(const SymmetricTensor& a, const SymmetricTensor& b) {
  return norm(a - b);
}

/// A random path of straight pieces with reversals, of strains about `size` at rates about `rate` (1/s).
inline std::vector<Segment> path_with_reversals(Random& random, double size, double rate, int pieces) {
  std::vector<Segment> path;
  SymmetricTensor at{};
  for (int i = 0; i < pieces; ++i) {
    // Half of the pieces turn back towards the origin.
    const SymmetricTensor to = random.chance(0.5) ? size * random.uniform(0.3, 1.0) * random.direction()
                                                  : random.uniform(-0.5, 0.9) * at;
    path.push_back({to - at, std::max(norm(to - at), 1e-3 * size) / rate});
    at = to;
  }
  return path;
}

}  // namespace vitrum::test
