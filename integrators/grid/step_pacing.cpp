#include "integrators/grid/step_pacing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mpm/computation_error.hpp"

namespace vitrum {

namespace {

/// A step that is still some roundings of the time long, s.
double rounding_of(double time, double target) {
  return 16.0 * std::numeric_limits<double>::epsilon() * std::max(std::abs(time), std::abs(target));
}

}  // namespace

double shortest_sensible_step(double critical_step, double time, double target) {
  return std::max(1e-9 * critical_step, rounding_of(time, target));
}

void require_above_rounding(double step, const char* key, double time, double target) {
  const double least = rounding_of(time, target);
  if (step < least)
    throw ComputationError(fmt::format(
        "integrator.{} = {:.3g} s is below {:.3g} s, where steps cannot be told from the rounding of the "
        "time {:.6g} s; choose it longer, or begin the scene nearer to t = 0",
        key, step, least, time));
}

void count_work(const sundials::ArkSolver::Counters& work, const IntegratorCounters& before,
                IntegratorCounters& c) {
  c.rejected = before.rejected + work.attempts - work.steps;
  c.rhs_evaluations = before.rhs_evaluations + work.right_hand_sides;
  c.newton_iterations = before.newton_iterations + work.newton_iterations;
  c.factorisations = before.factorisations + work.factorisations;
  c.factor_entries = std::max(c.factor_entries, work.factor_entries);
}

std::string failed_step(const sundials::ArkSolver::Step& step, const std::optional<double>& fixed,
                        const std::optional<double>& shortest, double critical_step) {
  if (fixed) return fmt::format("a step of integrator.fixed_step = {:.3g} s cannot be taken", *fixed);
  if (shortest && step.length <= 1.01 * *shortest)
    return fmt::format("the step would have to fall below integrator.min_step = {:.3g} s", *shortest);
  return fmt::format("the step has collapsed to {:.3g} s, {:.3g} of the critical step {:.4g} s", step.length,
                     step.length / critical_step, critical_step);
}

void count_step(const sundials::ArkSolver::Step& step, const sundials::ArkSolver::Counters& work,
                const IntegratorCounters& before, bool fixed, IntegratorCounters& c, StepLimit stability) {
  using Limit = sundials::ArkSolver::Limit;
  c.step_min = c.steps == 0 ? step.length : std::min(c.step_min, step.length);
  c.step_max = std::max(c.step_max, step.length);
  ++c.steps;
  count_work(work, before, c);
  c.count(fixed                            ? StepLimit::fixed
          : step.limit == Limit::stop      ? StepLimit::output
          : step.limit == Limit::stability ? stability
                                           : StepLimit::accuracy);
}

std::optional<std::size_t> first_not_finite(const double* values, std::size_t size) {
  double sum = 0.0;
#pragma omp simd reduction(+ : sum)
  for (std::size_t i = 0; i < size; ++i) sum += values[i];
  if (std::isfinite(sum)) return std::nullopt;
  for (std::size_t i = 0; i < size; ++i)
    if (!std::isfinite(values[i])) return i;
  return std::nullopt;  // a sum that overflows
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
