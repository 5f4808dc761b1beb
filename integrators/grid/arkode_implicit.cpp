#include "integrators/grid/arkode_implicit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "integrators/grid/critical_step.hpp"
#include "integrators/grid/step_pacing.hpp"
#include "mpm/computation_error.hpp"
#include "mpm/filter.hpp"
#include "mpm/loads.hpp"
#include "mpm/removal.hpp"
#include "mpm/transfer.hpp"
#include "mpm/velocity_filter.hpp"

namespace vitrum {

using sundials::ArkSolver;

void ArkodeImplicit::prepare(System& system) {
  context_ = std::make_unique<sundials::Context>();
  grid_ = std::make_unique<GridSystem>(system, settings_.scales, settings_.tolerance, remap_.travel);
  tolerated_energy_ = vitrum::tolerated_energy(system, settings_.scales, settings_.tolerance);
}

/// Phases up to a target, or to the next instant at which a boundary comes to hold other nodes or a
/// rate jumps, are of equal length, and short enough for the fastest particle.
double ArkodeImplicit::phase_end(const System& system, double target, double longest) const {
  require_above_rounding(remap_.duration, "remap", system.time, target);
  target = std::min(target, mpm::next_load_change(system));
  const double left = target - system.time;
  const double phases = std::max(1.0, std::ceil(left / longest - 1e-6));
  return phases <= 1.0 ? target : system.time + left / phases;
}

void ArkodeImplicit::start_solver(System& system, double phase_end, double target) {
  critical_step_ = critical_step(system, stability_limit(StepScheme::musl)).step;
  if (settings_.fixed_step) require_above_rounding(*settings_.fixed_step, "fixed_step", system.time, target);
  if (settings_.longest_step)
    require_above_rounding(*settings_.longest_step, "max_step", system.time, target);
  if (grid_->pattern().size() == 0) {
    solver_.reset();
    return;
  }
  if (!solver_ || solver_->size() != grid_->size() || pattern_ != grid_->pattern()) {
    before_ = state_.counters;
    pattern_ = grid_->pattern();
    sundials::ArkSettings ark;
    ark.fixed_step = settings_.fixed_step;
    if (settings_.longest_step) ark.longest_step = *settings_.longest_step;
    ark.growth = 10.0;
    ark.keep_up_to = 1.5;  // a factored matrix is worth more than a slightly longer step
    solver_ = std::make_unique<ArkSolver>(*context_, settings_.table, ark, *grid_, linear_);
  }
  solver_->set_shortest_step(std::max(settings_.shortest_step.value_or(0.0),
                                      shortest_sensible_step(critical_step_, system.time, target)));
  reached_.resize(grid_->size() + grid_->integrals());
  grid_->start(solver_->y());
  const double first =
      state_.next_step > 0.0 ? state_.next_step : settings_.first_step.value_or(critical_step_);
  solver_->start(system.time, std::min(first, phase_end - system.time));
}

/// One step within a phase; whether it ended the phase by reaching phase_end. length: s.
bool ArkodeImplicit::take_step(System& system, double phase_end, bool ends_at_target, double& length) {
  IntegratorCounters& counters = state_.counters;
  if (!solver_) {
    length = phase_end - system.time;
    grid_->carry(system.time, phase_end, carried_);
    grid_->commit(phase_end, carried_.data());
    count_step({ArkSolver::Failure::none, phase_end, length, ArkSolver::Limit::stop}, {}, counters,
               settings_.fixed_step.has_value(), counters);
    return true;
  }
  if (settings_.fixed_step) {
    const double left = phase_end - system.time;
    solver_->set_fixed_step(left / std::max(1.0, std::ceil(left / *settings_.fixed_step - 1e-6)));
  }
  const ArkSolver::Step step = attempt(phase_end);
  if (!settings_.fixed_step) grid_->add_errors(solver_->local_errors(), state_.error);
  grid_->commit(step.time, solver_->y());
  count_step(step, solver_->counters(), before_, settings_.fixed_step.has_value(), counters);
  if (counters.last_limit == StepLimit::output && !ends_at_target) {
    counters.last_limit = StepLimit::remap;
    --counters.limited_by_output, ++counters.limited_by_remap;
  }
  state_.next_step = solver_->next_step();
  length = step.length;
  system.time = step.time;
  return step.limit == ArkSolver::Limit::stop;
}

/// Whether shape functions of the phase's beginning are no longer good for where nodes have come to.
bool ArkodeImplicit::has_gone_far(const double* y, double way_at_walls) const {
  return grid_->deformation() > remap_.strain || grid_->travel(y) > remap_.travel ||
         (std::isfinite(way_at_walls) && grid_->travel_at_walls(y) > way_at_walls);
}

bool ArkodeImplicit::advance(System& system, double target, StepObserver& observer) {
  if (!grid_) prepare(system);
  // Neither the order in which particles are stored and energies summed, nor pivots and rates of convergence
  // must depend on what came before a checkpoint.
  system.grid_is_stale = true;
  solver_.reset();
  bool goes_on = true;
  while (goes_on && system.time < target) {
    grid_->begin_phase();
    const PhaseBounds bounds = phase_bounds(system, remap_);
    const double end = phase_end(system, target, bounds.duration);
    const double began = system.time;
    start_solver(system, end, target);
    bool phase_over = false;
    while (!phase_over) {
      double length = 0.0;
      phase_over = take_step(system, end, end == target, length);
      if (phase_over) system.time = end;
      ++system.step_index;
      const double* y = solver_ ? solver_->y() : carried_.data();
      phase_over = phase_over || has_gone_far(y, bounds.way_at_walls);
      system.record.filtered = 0.0;
      if (phase_over) {
        state_.remap_loss += grid_->end_phase(y), ++state_.phases;
        if (system.flip != 1.0) mpm::refresh_grid_for_positions(system), mpm::filter_velocities(system);
        mpm::filter_pressures(system, began, system.time);
        mpm::remove_particles(system);
      }
      goes_on = observer.step_done(system, length);
      if (!goes_on && !phase_over) {  // stopped on the way: particles must stand where they are
        const double loss = grid_->end_phase(y);
        state_.remap_loss += loss, ++state_.phases;
        break;
      }
    }
  }
  return system.time >= target;
}

/// A step. Where none can be taken the phase ends at the last one, so that particles stand where their stress
/// belongs. (ARKODE leaves its last attempt in y when the step is the shortest already.)
ArkSolver::Step ArkodeImplicit::attempt(double phase_end) {
  std::copy_n(solver_->y(), reached_.size(), reached_.begin());
  const auto leave = [&] {
    count_work(solver_->counters(), before_, state_.counters);
    state_.remap_loss += grid_->end_phase(reached_.data()), ++state_.phases;
  };
  ArkSolver::Step step;
  try {
    step = solver_->step(phase_end);
  } catch (...) {
    leave();
    throw;
  }
  if (step.failure == ArkSolver::Failure::none) return step;
  const std::string message = describe_failure(step);  // before the phase is left
  leave();
  throw ComputationError(message);
}

std::string ArkodeImplicit::advice_on_loss(const System& system, double step, double lost) const {
  if (!(state_.remap_loss > 0.5 * lost)) return advice(system, step);
  return fmt::format(
      "most of it at remaps, where material is pressed by more than {:g} %: in impacts try "
      "integrator.method = \"arkode-explicit\" with integrator.order = 4, in slow scenes more particles "
      "a cell or integrator.remap_travel = {:.2g}",
      100.0 * mpm::ConsistentMass::lumped_from, 0.2 * remap_.travel);
}

std::string ArkodeImplicit::describe_failure(const ArkSolver::Step& step) const {
  std::string cause = "the right-hand side cannot be evaluated there";
  if (const auto unknown = grid_->not_finite())
    cause += "; not finite: the rate of " + grid_->describe(*unknown);
  if (step.failure == ArkSolver::Failure::error_test) {
    const double* errors = solver_->local_errors();
    const std::size_t worst = worst_unknown(errors, solver_->weights(), solver_->size());
    cause = fmt::format("largest weighted error: {}, error {:.3g} where {:.3g} is tolerated",
                        grid_->describe(worst), std::abs(errors[worst]), grid_->tolerance_of(worst));
  } else if (step.failure == ArkSolver::Failure::newton) {
    cause = "Newton's iteration does not converge";
    const std::vector<double>& correction = solver_->last_correction();
    if (!correction.empty()) {
      const std::size_t worst = worst_unknown(correction.data(), solver_->weights(), solver_->size());
      cause += fmt::format("; largest weighted correction: {}, {:.3g} where {:.3g} is tolerated",
                           grid_->describe(worst), std::abs(correction[worst]), grid_->tolerance_of(worst));
    }
  }
  return fmt::format(
      "{}; {}; {}", failed_step(step, settings_.fixed_step, settings_.shortest_step, critical_step_), cause,
      settings_.fixed_step
          ? "try a smaller integrator.fixed_step"
          : fmt::format("try a larger integrator.rtol (now {:g}){}, a smaller integrator.remap (now {}), or "
                        "integrator.method = \"arkode-explicit\"",
                        settings_.tolerance, settings_.shortest_step ? ", a smaller integrator.min_step" : "",
                        std::isfinite(remap_.duration) ? fmt::format("{:g} s", remap_.duration) : "none"));
}

}  // namespace vitrum
