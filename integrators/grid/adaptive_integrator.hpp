#pragma once
#include <fmt/format.h>

#include <memory>
#include <string>

#include "integrators/grid/adaptive_settings.hpp"
#include "integrators/grid/grid_integrator.hpp"
#include "integrators/sundials/ark_solver.hpp"

namespace vitrum {

/// What the methods of ARKODE share: their settings, the state that a checkpoint keeps, and the solver.
class AdaptiveIntegrator : public GridIntegrator {
 public:
  const IntegratorState& state() const final { return state_; }
  void restore(const IntegratorState& state) final { state_ = state; }
  bool estimates_errors() const final { return !settings_.fixed_step; }
  double tolerated_energy(const System& /*system*/) const final { return tolerated_energy_; }
  std::string advice(const System& /*system*/, double /*step*/) const final {
    return settings_.fixed_step
               ? fmt::format("try integrator.fixed_step = {:.2g}", 0.5 * *settings_.fixed_step)
               : fmt::format("try integrator.rtol = {:.2g}", 0.1 * settings_.tolerance);
  }

 protected:
  explicit AdaptiveIntegrator(const AdaptiveSettings& settings) : settings_(settings) {}

  AdaptiveSettings settings_;
  IntegratorState state_;
  std::unique_ptr<sundials::Context> context_;
  std::unique_ptr<sundials::ArkSolver>
      solver_;                     ///< null before the first step, and where nothing is free to move
  double tolerated_energy_ = 0.0;  ///< J (per radian or per metre)
  IntegratorCounters before_;      ///< work of earlier solvers
};

}  // namespace vitrum
