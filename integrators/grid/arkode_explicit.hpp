#pragma once
#include <memory>

#include "integrators/grid/adaptive_integrator.hpp"
#include "integrators/grid/particle_system.hpp"

namespace vitrum {

/// The particle system under ARKODE's explicit Runge-Kutta methods, with steps chosen by the estimated error
/// and bounded by the critical step, or fixed. Every target starts the method anew, so that a run resumed at
/// one goes on as the uninterrupted run did.
class ArkodeExplicit final : public AdaptiveIntegrator {
 public:
  explicit ArkodeExplicit(const AdaptiveSettings& settings) : AdaptiveIntegrator(settings) {}

  bool advance(System& system, double target, StepObserver& observer) override;
  std::string advice_on_loss(const System& system, double step, double lost) const override;

 private:
  void prepare(System& system);
  void begin(const System& system, double target);
  sundials::ArkSolver::Step attempt(double target);
  [[noreturn]] void fail(const System& system, const sundials::ArkSolver::Step& step);

  std::unique_ptr<ParticleSystem> particles_;
};

}  // namespace vitrum
