#pragma once
#include <array>

#include "observe/failure_report.hpp"
#include "observe/fragments.hpp"
#include "observe/observer.hpp"
#include "scene/scene.hpp"

namespace vitrum {

/// How much of a body has failed.
struct Failed {
  std::size_t localised = 0, separated = 0;  ///< particles
  double crack_area = 0.0, volume = 0.0;     ///< sums of V0/L_e and V0 of the localised, SI
};
/// whole: how much of the body a particle's mass counts for (2 pi in axisymmetric scenes).
Failed failed_part(const Body& body, double whole);

/// Follows failure through a run: first events as they happen, fronts and fragments on demand.
class FailureAnalysis final : public Observer {
 public:
  static std::unique_ptr<Observer> make(const Scene& /*scene*/, const System& system) {
    return std::make_unique<FailureAnalysis>(system);
  }
  explicit FailureAnalysis(const System& system);

  void step(const System& system, double duration) override;
  void declare(const System& system, std::vector<Quantity>& quantities) const override;
  void save(Archive& archive) const override;
  void restore(const Archive& archive) override;

  /// The report on the present state. with_fragments: also finds the connected pieces.
  FailureReport report(const System& system, bool with_fragments) const;

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

  /// First events of one body.
  struct Memory {
    std::optional<FirstEvent> damage, localisation, separation;
  };
  struct NamedEvent;
  static const std::array<NamedEvent, 3> named_events;
  std::vector<Memory> memory_;  ///< by body
};

}  // namespace vitrum
