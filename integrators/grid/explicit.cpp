#include "integrators/grid/explicit.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mpm/carried.hpp"
#include "mpm/centroids.hpp"
#include "mpm/coasting.hpp"
#include "mpm/computation_error.hpp"
#include "mpm/contact/contact.hpp"
#include "mpm/domain.hpp"
#include "mpm/filter.hpp"
#include "mpm/loads.hpp"
#include "mpm/reactions.hpp"
#include "mpm/removal.hpp"
#include "mpm/tractions.hpp"
#include "mpm/transfer.hpp"
#include "mpm/velocity_filter.hpp"

namespace vitrum {

using mpm::Gather;
using mpm::Scatter;

ExplicitIntegrator::ExplicitIntegrator(StepScheme scheme, std::optional<double> step,
                                       std::optional<double> courant)
    : scheme_(scheme), step_(step), courant_(courant) {}

void ExplicitIntegrator::take_step(System& system, double duration) const {
  mpm::set_loads_of_step(system, duration);
  system.grid.move_boundaries(system.time);
  mpm::find_coasting(system);
  mpm::refresh_grid_and_wake(system);
  system.record.filtered = 0.0;
  mpm::filter_velocities(system);
  system.record.external_work = mpm::carry_held(system).work;
  mpm::filter_pressures(system, system.time, system.time + duration);
  mpm::find_centroids(system);
  if (system.contact) system.contact->begin_step(system, duration);
  if (system.tractions) {
    if (!system.contact) mpm::Contact::unload(system);
    system.tractions->load(system, system.time, mpm::configurations(system));
  }
  mpm::StressUpdate stress(system, duration);
  const auto scatter = [&](Scatter what) {
    return mpm::scatter_pass(system, what, mpm::Nodes::moved, duration);
  };
  const auto gather = [&](Gather what, mpm::StressUpdate* update = nullptr) {
    return mpm::gather_pass(system, what, duration, update);
  };
  std::vector<mpm::Pass> until_moved, then;  // nodes have
  switch (scheme_) {
    case StepScheme::usf:
      until_moved = {scatter(Scatter::momentum), gather(Gather::strain, &stress), scatter(Scatter::force)};
      then = {gather(Gather::velocity_and_position)};
      break;
    case StepScheme::usl:
      until_moved = {scatter(Scatter::momentum_and_force)};
      then = {gather(Gather::all_from_new, &stress)};
      break;
    case StepScheme::musl:
      until_moved = {scatter(Scatter::momentum_and_force)};
      then = {gather(Gather::velocity_and_rescatter), gather(Gather::strain_and_position, &stress)};
      break;
  }
  if (system.tractions) {  // whose work is that on nodes between
    mpm::sweep(system, until_moved);
    system.tractions->book_work(system, duration);
    mpm::sweep(system, then);
  } else {
    until_moved.insert(until_moved.end(), then.begin(), then.end());
    mpm::sweep(system, until_moved);
  }
  stress.book();
  mpm::update_domains(system);
  mpm::book_reactions(system, duration);
  mpm::coast(system, duration);
  if (system.contact) system.contact->end_step(system);
  mpm::remove_particles(system);
  ++system.step_index;
  if (system.contact && system.step_index % mpm::Contact::steps_between_looks == 0)
    system.contact->part(system);
}

void ExplicitIntegrator::count(double duration) {
  IntegratorCounters& c = state_.counters;
  c.step_min = c.steps == 0 ? duration : std::min(c.step_min, duration);
  c.step_max = std::max(c.step_max, duration);
  ++c.steps;
  ++c.rhs_evaluations;
  c.last_limit = StepLimit::fixed;
}

bool ExplicitIntegrator::advance(System& system, double target, StepObserver& observer) {
  return step_ ? advance_fixed(system, target, observer) : advance_courant(system, target, observer);
}

bool ExplicitIntegrator::advance_fixed(System& system, double target, StepObserver& observer) {
  if (state_.segment_steps == 0) {  // otherwise: resumed in the middle of a segment
    state_.segment_start = system.time;
    state_.segment_steps =
        static_cast<std::int64_t>(std::max(1.0, std::ceil((target - system.time) / *step_ - 1e-6)));
    state_.segment_done = 0;
  }
  const double span = target - state_.segment_start;
  const double duration = span / static_cast<double>(state_.segment_steps);
  while (state_.segment_done < state_.segment_steps) {
    take_step(system, duration);
    count(duration);
    if (duration < *step_ * (1.0 - 1e-6)) {
      state_.counters.count(StepLimit::output);
    }
    ++state_.segment_done;
    const bool last = state_.segment_done == state_.segment_steps;
    system.time = last ? target : state_.segment_start + duration * static_cast<double>(state_.segment_done);
    if (last) state_.segment_steps = state_.segment_done = 0;
    if (!observer.step_done(system, duration)) return last;
    if (last) return true;
  }
  return true;
}

bool ExplicitIntegrator::advance_courant(System& system, double target, StepObserver& observer) {
  while (system.time < target) {
    const CriticalStep critical = critical_step(system, stability_limit(scheme_));
    const double stable = *courant_ * critical.step;
    // Particles that run away shrink the step without end: a hang, unless it is called what it is.
    if (!(critical.travel_speed < 1e6 * critical.wave_speed))
      throw ComputationError(fmt::format(
          "the step has collapsed to {:.3g} s because a particle of body '{}' moves at {:.3g} m/s, "
          "over a million times its wave speed",
          stable, critical.body, critical.travel_speed));
    const double left = target - system.time;
    if (!(system.time + stable > system.time))
      throw ComputationError(
          fmt::format("the step has collapsed to {:.3g} s, below the rounding of the time {:.6g} s", stable,
                      system.time));
    // The last two steps share what is left, so that no step is much shorter than its neighbours.
    const bool last = left <= stable * (1.0 + 1e-9);
    const double duration = last ? left : (left < 2.0 * stable ? 0.5 * left : stable);
    take_step(system, duration);
    count(duration);
    const bool cut = duration < stable;
    state_.counters.count(cut                         ? StepLimit::output
                          : critical.touching.empty() ? StepLimit::stability
                                                      : StepLimit::contact);
    system.time = last ? target : system.time + duration;
    if (!observer.step_done(system, duration)) return last;
  }
  return true;
}

std::string ExplicitIntegrator::advice(const System& system, double step) const {
  // The critical step of the scene's own speeds: those of a run that has blown up would tell nothing.
  const CriticalStep limit = critical_step(system, stability_limit(scheme_), Touching::any, Speeds::of_waves);
  const double critical = limit.step;
  const std::string length =
      fmt::format("the step {:.4g} s is {:.3g} times the critical step {:.4g} s of bodies at rest{}; try ",
                  step, step / critical, critical,
                  limit.touching.empty()
                      ? ""
                      : fmt::format(", which contact of '{}' and '{}' shortens", limit.body, limit.touching));
  // No smaller step would help.
  if (scheme_ == StepScheme::usl && step <= 0.5 * critical)
    return length +
           "integrator.scheme = \"musl\": a node that is nearly empty has no stable step under \"usl\"";
  // Below a step that has just failed, however small that was.
  const double advised = step > 0.0 ? std::min(0.4 * critical, 0.5 * step) : 0.4 * critical;
  return length +
         fmt::format("integrator.step = {:.2g} or integrator.courant = {:.2g}", advised, advised / critical);
}

}  // namespace vitrum
