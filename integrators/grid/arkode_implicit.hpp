#pragma once
#include <memory>

#include "integrators/grid/adaptive_integrator.hpp"
#include "integrators/grid/grid_system.hpp"
#include "integrators/grid/phase_length.hpp"

namespace vitrum {

/// The grid system under ARKODE's diagonally implicit Runge-Kutta methods: Lagrangian phases of some steps
/// each, after which particles move and the grid begins anew. Every target starts the solver anew, so that a
/// run resumed at one goes on as the uninterrupted run did.
class ArkodeImplicit final : public AdaptiveIntegrator {
 public:
  ArkodeImplicit(const AdaptiveSettings& settings, const RemapSettings& remap,
                 sundials::LinearSolverKind linear)
      : AdaptiveIntegrator(settings), remap_(remap), linear_(linear) {}

  bool advance(System& system, double target, StepObserver& observer) override;
  std::string advice_on_loss(const System& system, double step, double lost) const override;

 private:
  void prepare(System& system);
  void start_solver(System& system, double phase_end, double target);
  double phase_end(const System& system, double target, double longest) const;
  bool has_gone_far(const double* y, double way_at_walls) const;
  bool take_step(System& system, double phase_end, bool ends_at_target, double& length);
  sundials::ArkSolver::Step attempt(double phase_end);
  std::string describe_failure(const sundials::ArkSolver::Step& step) const;

  RemapSettings remap_;
  sundials::LinearSolverKind linear_;
  std::unique_ptr<GridSystem> grid_;
  std::vector<double> carried_;  ///< the unknowns without a solver: the external work at most
  std::vector<double> reached_;  ///< the unknowns and integrals at the end of the last step
  sundials::SparsePattern pattern_;
  double critical_step_ = 0.0;
};

}  // namespace vitrum
