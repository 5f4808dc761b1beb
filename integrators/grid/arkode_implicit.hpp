#pragma once
#include <memory>

#include "integrators/grid/adaptive_settings.hpp"
#include "integrators/grid/grid_integrator.hpp"
#include "integrators/grid/grid_system.hpp"
#include "integrators/sundials/ark_solver.hpp"

namespace vitrum {

/// When a Lagrangian phase ends.
struct RemapSettings {
  double duration = 1.0e-6;  ///< s
  double travel = 0.25;      ///< cells that a particle may move
  double strain = 0.02;      ///< that a particle may strain, or turn (rad)
};

/// The grid system under ARKODE's diagonally implicit Runge-Kutta methods: Lagrangian phases of some steps
/// each, after which particles move and the grid begins anew. Every target starts the solver anew, so that a
/// run resumed at one goes on as the uninterrupted run did.
class ArkodeImplicit final : public GridIntegrator {
 public:
  ArkodeImplicit(const AdaptiveSettings& settings, const RemapSettings& remap,
                 sundials::LinearSolverKind linear)
      : settings_(settings), remap_(remap), linear_(linear) {}

  bool advance(System& system, double target, StepObserver& observer) override;
  const IntegratorState& state() const override { return state_; }
  void restore(const IntegratorState& state) override { state_ = state; }
  bool estimates_errors() const override { return !settings_.fixed_step; }
  double tolerated_energy(const System&) const override { return tolerated_energy_; }
  std::string advice(const System& system, double step) const override;

 private:
  void prepare(System& system);
  void begin_phase(System& system, double phase_end, double target);
  double phase_end(const System& system, double target) const;
  bool take_step(System& system, double phase_end, bool ends_at_target, double& length);
  sundials::ArkSolver::Step attempt(double phase_end);
  std::string describe_failure(const sundials::ArkSolver::Step& step) const;

  AdaptiveSettings settings_;
  RemapSettings remap_;
  sundials::LinearSolverKind linear_;
  IntegratorState state_;
  std::unique_ptr<sundials::Context> context_;
  std::unique_ptr<GridSystem> grid_;
  std::unique_ptr<sundials::ArkSolver>
      solver_;                   ///< for the present pattern; null where nothing is free to move
  std::vector<double> carried_;  ///< the unknowns without a solver: the external work at most
  sundials::SparsePattern pattern_;
  double tolerated_energy_ = 0.0;
  IntegratorCounters before_;  ///< work of earlier solvers
  double critical_step_ = 0.0;
};

}  // namespace vitrum
