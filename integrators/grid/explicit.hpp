#pragma once
#include <optional>

#include "integrators/grid/critical_step.hpp"
#include "integrators/grid/grid_integrator.hpp"

namespace vitrum {

/// The explicit schemes of the material point method: stress first (USF), last (USL), or last with momenta
/// projected anew (MUSL). Either a fixed step, shortened evenly so that targets are met exactly, or a
/// fraction of the critical step.
class ExplicitIntegrator final : public GridIntegrator {
 public:
  /// Exactly one of step (s) and courant is given.
  ExplicitIntegrator(StepScheme scheme, std::optional<double> step, std::optional<double> courant);

  bool advance(System& system, double target, StepObserver& observer) override;
  const IntegratorState& state() const override { return state_; }
  void restore(const IntegratorState& state) override { state_ = state; }
  std::string advice(const System& system, double step) const override;

 private:
  void take_step(System& system, double duration) const;
  bool advance_fixed(System& system, double target, StepObserver& observer);
  bool advance_courant(System& system, double target, StepObserver& observer);
  void count(double duration);

  StepScheme scheme_;
  std::optional<double> step_, courant_;
  IntegratorState state_;
};

}  // namespace vitrum
