#include "integrators/grid/step_pacing.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vitrum {

double shortest_sensible_step(double critical_step, double time, double target) {
  const double rounding = std::numeric_limits<double>::epsilon() * std::max(std::abs(time), std::abs(target));
  return std::max(1e-9 * critical_step, 16.0 * rounding);
}

void count_step(const sundials::ArkSolver::Step& step, const sundials::ArkSolver::Counters& work,
                const IntegratorCounters& before, bool fixed, IntegratorCounters& c) {
  using Limit = sundials::ArkSolver::Limit;
  c.step_min = c.steps == 0 ? step.length : std::min(c.step_min, step.length);
  c.step_max = std::max(c.step_max, step.length);
  ++c.steps;
  c.rejected = before.rejected + work.attempts - work.steps;
  c.rhs_evaluations = before.rhs_evaluations + work.right_hand_sides;
  c.newton_iterations = before.newton_iterations + work.newton_iterations;
  c.factorisations = before.factorisations + work.factorisations;
  if (fixed) {
    c.last_limit = StepLimit::fixed;
  } else if (step.limit == Limit::stop) {
    c.last_limit = StepLimit::output, ++c.limited_by_output;
  } else if (step.limit == Limit::stability) {
    c.last_limit = StepLimit::stability, ++c.limited_by_stability;
  } else {
    c.last_limit = StepLimit::accuracy, ++c.limited_by_accuracy;
  }
}

std::size_t worst_unknown(const double* values, const double* weights, std::size_t size) {
  std::size_t worst = 0;
  double largest = -1.0;
  for (std::size_t i = 0; i < size; ++i) {
    const double weighted = std::abs(values[i]) * weights[i];
    if (std::isnan(weighted)) return i;
    if (weighted > largest) largest = weighted, worst = i;
  }
  return worst;
}

}  // namespace vitrum
