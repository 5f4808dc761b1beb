#include "integrators/grid/arkode_explicit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "integrators/grid/step_pacing.hpp"
#include "mpm/computation_error.hpp"
#include "mpm/loads.hpp"

namespace vitrum {

using sundials::ArkSolver;

void ArkodeExplicit::prepare(System& system) {
  context_ = std::make_unique<sundials::Context>();
  particles_ = std::make_unique<ParticleSystem>(system, settings_.scales, settings_.tolerance,
                                                settings_.table.oscillation_limit());
  if (!settings_.fixed_step)
    tolerated_energy_ = vitrum::tolerated_energy(system, settings_.scales, settings_.tolerance);
  sundials::ArkSettings ark;
  ark.fixed_step = settings_.fixed_step;
  if (settings_.longest_step) ark.longest_step = *settings_.longest_step;
  solver_ = std::make_unique<ArkSolver>(*context_, settings_.table, ark, *particles_);
  before_ = state_.counters;
}

void ArkodeExplicit::begin(const System& system, double target) {
  if (settings_.fixed_step) require_above_rounding(*settings_.fixed_step, "fixed_step", system.time, target);
  if (settings_.longest_step)
    require_above_rounding(*settings_.longest_step, "max_step", system.time, target);
  double* y = solver_->y();
  particles_->begin(y, mpm::next_load_change(system));
  const double critical = particles_->stable_step(system.time, y);
  solver_->set_shortest_step(
      std::max(settings_.shortest_step.value_or(0.0), shortest_sensible_step(critical, system.time, target)));
  const double first = settings_.first_step.value_or(0.1 * critical);
  solver_->start(system.time, state_.next_step > 0.0 ? state_.next_step : first);
}

bool ArkodeExplicit::advance(System& system, double target, StepObserver& observer) {
  if (!solver_) prepare(system);
  begin(system, target);
  const std::optional<double> fixed = settings_.fixed_step;
  while (system.time < target) {
    // No step goes over an instant at which a boundary comes to hold other nodes, or a rate jumps.
    const double stop = std::min(target, mpm::next_load_change(system));
    if (fixed) {  // equal steps, not longer than asked for
      const double left = stop - system.time;
      solver_->set_fixed_step(left / std::max(1.0, std::ceil(left / *fixed - 1e-6)));
    }
    const ArkSolver::Step step = attempt(stop);
    if (step.failure != ArkSolver::Failure::none) fail(system, step);
    if (!fixed) particles_->add_errors(solver_->local_errors(), state_.error);
    const bool replaced = particles_->commit(step.time, solver_->y());
    system.time = step.limit == ArkSolver::Limit::stop ? stop : step.time;
    ++system.step_index;
    count_step(step, solver_->counters(), before_, fixed.has_value(), state_.counters,
               particles_->contact_limits() ? StepLimit::contact : StepLimit::stability);
    state_.next_step = solver_->next_step();
    if (!observer.step_done(system, step.length)) return system.time >= target;
    if ((replaced || system.time == stop) && system.time < target) begin(system, target);
  }
  return true;
}

/// A step; the work of one that fails is counted, too.
ArkSolver::Step ArkodeExplicit::attempt(double target) {
  try {
    const ArkSolver::Step step = solver_->step(target);
    count_work(solver_->counters(), before_, state_.counters);
    return step;
  } catch (...) {
    count_work(solver_->counters(), before_, state_.counters);
    throw;
  }
}

std::string ArkodeExplicit::advice_on_loss(const System& system, double step, double /*lost*/) const {
  if (settings_.table.order != 3) return advice(system, step);
  return "order 3 damps short waves: try integrator.order = 4, or " + advice(system, step).substr(4);
}

void ArkodeExplicit::fail(const System& system, const ArkSolver::Step& step) {
  const double critical = particles_->stable_step(system.time, solver_->y());
  std::string cause = "the right-hand side cannot be evaluated there";
  if (const auto unknown = particles_->not_finite())
    cause += "; not finite: the rate of " + particles_->describe(*unknown);
  if (step.failure == ArkSolver::Failure::error_test) {
    const double* errors = solver_->local_errors();
    const std::size_t worst = worst_unknown(errors, solver_->weights(), solver_->size());
    cause =
        fmt::format("largest weighted error: {}, error {:.3g} where {:.3g} is tolerated",
                    particles_->describe(worst), std::abs(errors[worst]), particles_->tolerance_of(worst));
  }
  throw ComputationError(fmt::format(
      "{}; {}; {}", failed_step(step, settings_.fixed_step, settings_.shortest_step, critical), cause,
      settings_.fixed_step
          ? "try a smaller integrator.fixed_step"
          : fmt::format("try a larger integrator.rtol (now {:g}){} or smoother space.shape_functions",
                        settings_.tolerance,
                        settings_.shortest_step ? ", a smaller integrator.min_step" : "")));
}

}  // namespace vitrum
