#pragma once
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "tensor/symmetric.hpp"

// What increments tell besides the state at their end: events, dissipation, the work of solvers.

namespace vitrum {

enum class EventKind { damage, yield, peak, localisation, separation, closure };
inline constexpr std::size_t event_kinds = 6;
std::string_view event_name(EventKind kind);

/// Something that happened inside an increment, at `fraction` in [0, 1] of it, and the largest principal
/// stress (Pa) that the point bore there: of a localisation, its strength.
struct Event {
  EventKind kind;
  double fraction, stress;
};

/// Energy turned into heat and surface by an increment, J per m^3 of material. `snap_back` is the part of
/// `fracture` that an instantaneous release dissipated beyond what the traction-opening relation of eq. 13
/// asks for.
struct Dissipation {
  double plastic = 0.0, damage = 0.0, fracture = 0.0, snap_back = 0.0;

  constexpr double total() const { return plastic + damage + fracture; }
  constexpr Dissipation& operator+=(const Dissipation& o) {
    plastic += o.plastic, damage += o.damage, fracture += o.fracture, snap_back += o.snap_back;
    return *this;
  }
};

/// Work of ODE solvers. Zero for closed-form responses.
struct SolverCounters {
  std::int64_t increments = 0;  ///< that reached a solver
  std::int64_t solves = 0;      ///< modes integrated
  std::int64_t steps = 0, right_hand_sides = 0;
  std::int64_t failures = 0;  ///< attempts that failed and were repeated by other means

  constexpr SolverCounters& operator+=(const SolverCounters& o) {
    increments += o.increments, solves += o.solves, steps += o.steps;
    right_hand_sides += o.right_hand_sides, failures += o.failures;
    return *this;
  }
};

/// What one increment of one point did besides changing its state.
struct PointReport {
  std::vector<Event> events;  ///< in the order in which they happened
  Dissipation dissipation;
  SolverCounters solver;
  std::string cause;  ///< not empty: the increment could not be integrated

  bool failed() const { return !cause.empty(); }
  /// Forgets the last increment.
  void clear() { events.clear(), dissipation = {}, solver = {}, cause.clear(); }

  /// Events come in the order in which they happen; what rounding says otherwise is no time.
  void record(EventKind kind, double fraction, const SymmetricTensor& stress) {
    if (!events.empty()) fraction = std::max(fraction, events.back().fraction);
    events.push_back({kind, fraction, largest_principal(stress)});
  }
};

/// An event of a batch, with the index of its particle.
struct ParticleEvent {
  std::size_t particle;
  Event event;
};

/// Sums over a range of particles, joules (per radian or per metre).
struct BatchReport {
  double elastic = 0.0;    ///< stored energy at the end of the increment
  Dissipation dissipated;  ///< joules here, not J/m^3
  std::vector<ParticleEvent> events;
  SolverCounters solver;
  /// The first particle whose increment could not be integrated; its state is left as before the increment.
  std::optional<std::size_t> failed;
  SymmetricTensor failed_increment;  ///< strain increment of that failure
  std::string cause;                 ///< of that failure

  /// Whether it tells of anything but elastic energy.
  bool tells_more() const {
    return dissipated.total() != 0.0 || dissipated.snap_back != 0.0 || !events.empty() ||
           solver.increments != 0 || failed.has_value();
  }

  /// Back to zero; keeps its memory.
  void clear() {
    elastic = 0.0, dissipated = {}, solver = {};
    events.clear(), failed.reset(), cause.clear();
  }
};

}  // namespace vitrum
