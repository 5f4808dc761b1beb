#pragma once
#include <memory>

#include "integrators/grid/adaptive_settings.hpp"
#include "integrators/grid/grid_integrator.hpp"
#include "integrators/grid/particle_system.hpp"
#include "integrators/sundials/ark_solver.hpp"

namespace vitrum {

/// The particle system under ARKODE's explicit Runge-Kutta methods, with steps chosen by the estimated error
/// and bounded by the critical step, or fixed. Every target starts the method anew, so that a run resumed at
/// one goes on as the uninterrupted run did.
class ArkodeExplicit final : public GridIntegrator {
 public:
  explicit ArkodeExplicit(const AdaptiveSettings& settings) : settings_(settings) {}

  bool advance(System& system, double target, StepObserver& observer) override;
  const IntegratorState& state() const override { return state_; }
  void restore(const IntegratorState& state) override { state_ = state; }
  bool estimates_errors() const override { return !settings_.fixed_step; }
  double tolerated_energy(const System&) const override { return tolerated_energy_; }
  std::string advice(const System& system, double step) const override;

 private:
  void prepare(System& system);
  void begin(const System& system, double target);
  sundials::ArkSolver::Step attempt(double target);
  [[noreturn]] void fail(const System& system, const sundials::ArkSolver::Step& step);

  AdaptiveSettings settings_;
  IntegratorState state_;
  std::unique_ptr<sundials::Context> context_;
  std::unique_ptr<ParticleSystem> particles_;
  std::unique_ptr<sundials::ArkSolver> solver_;
  double tolerated_energy_ = 0.0;
  IntegratorCounters before_;  ///< work of earlier solvers (a resumed run)
};

}  // namespace vitrum
