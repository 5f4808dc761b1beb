#pragma once
#include <array>

#include "analysis/failure_report.hpp"
#include "analysis/fragments.hpp"
#include "mpm/system.hpp"

namespace vitrum {

/// Follows failure through a run: first events as they happen, fronts and fragments on demand.
class FailureAnalysis {
 public:
  explicit FailureAnalysis(const System& system);

  /// Looks at the events of the last step, which was `step` seconds long.
  void observe(const System& system, double step);
  /// The report on the present state. with_fragments: also finds the connected pieces.
  FailureReport report(const System& system, bool with_fragments) const;

  /// First events of one body: what a checkpoint keeps.
  struct Memory {
    std::optional<FirstEvent> damage, localisation, separation;
  };
  const std::vector<Memory>& memory() const { return memory_; }
  /// One entry per body.
  void restore(std::vector<Memory> memory) { memory_ = std::move(memory); }

 private:
  void choose_projectile(const System& system);
  std::optional<bool> perforated(const System& system, const std::vector<ConnectedPiece>& pieces) const;

  /// Extent of a body at the start.
  struct Extent {
    std::array<double, 2> min, max;
  };
  std::vector<Extent> extents_;
  std::optional<std::size_t> projectile_, target_;
  std::size_t direction_ = 1;             ///< component along which the projectile moves
  double sense_ = -1.0;                   ///< and its sign
  std::vector<double> damaging_density_;  ///< by body: the crack density at which damage passes its threshold
  std::vector<Memory> memory_;            ///< by body
};

}  // namespace vitrum
