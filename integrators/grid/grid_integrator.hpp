#pragma once
#include <cstdint>
#include <string>

#include "integrators/grid/step_limit.hpp"
#include "mpm/system.hpp"

namespace vitrum {

/// How much work the integration of the momentum equations took so far.
struct IntegratorCounters {
  std::int64_t steps = 0, rejected = 0, rhs_evaluations = 0, newton_iterations = 0, factorisations = 0;
  std::int64_t factor_entries = 0;        ///< most numbers in the sparse factors of a phase
  double step_min = 0.0, step_max = 0.0;  ///< s; 0 before the first step
  std::int64_t limited_by_stability = 0, limited_by_contact = 0, limited_by_accuracy = 0,
               limited_by_output = 0, limited_by_remap = 0;
  StepLimit last_limit = StepLimit::fixed;  ///< of the last step

  /// Enters what kept a step from being longer.
  void count(StepLimit limit) {
    last_limit = limit;
    if (limit == StepLimit::stability) ++limited_by_stability;
    if (limit == StepLimit::contact) ++limited_by_contact;
    if (limit == StepLimit::accuracy) ++limited_by_accuracy;
    if (limit == StepLimit::output) ++limited_by_output;
    if (limit == StepLimit::remap) ++limited_by_remap;
  }
};

/// Sums over all steps of the estimated local error, a root mean square over the unknowns of a group,
/// relative to the scale of the group (not to the tolerance). Methods that make no estimate leave zeros.
struct ErrorEstimate {
  double position = 0.0;  ///< of particles, or displacement of nodes
  double velocity = 0.0;  ///< of particles, or of nodes
  double strain = 0.0;    ///< and spin, of particles; nodes have none
  double total = 0.0;     ///< of all unknowns together
};

/// How much work the local constitutive equations took so far.
struct ConstitutiveCounters {
  std::int64_t evaluations = 0, events = 0;
  SolverCounters solver;  ///< of the substepper or of CVODE
};

/// Sees every accepted step; may stop the run.
class StepObserver {
 public:
  virtual ~StepObserver() = default;
  /// Returns false to stop after this step (the integrator then returns with the time reached).
  /// step: s, just taken; system.record says what it did.
  virtual bool step_done(System& system, double step) = 0;
};

/// What must be kept besides the particles so that a resumed run takes the same steps.
struct IntegratorState {
  double segment_start = 0.0;      ///< s, time of the last output or checkpoint target reached
  std::int64_t segment_steps = 0;  ///< equal steps planned from there to the next target; 0: none planned
  std::int64_t segment_done = 0;   ///< of these, taken
  double next_step = 0.0;          ///< s, adaptive methods: the step to go on with; 0: none yet
  ErrorEstimate error;
  double remap_loss =
      0.0;  ///< kinetic energy lost between grid and particles so far, J (per radian or metre)
  std::int64_t phases = 0;  ///< Lagrangian phases so far
  IntegratorCounters counters;
};

/// Advances a whole system in time.
class GridIntegrator {
 public:
  virtual ~GridIntegrator() = default;
  /// Steps to `target` (s) or until the observer stops it. Returns true when the target is reached.
  virtual bool advance(System& system, double target, StepObserver& observer) = 0;
  virtual const IntegratorState& state() const = 0;
  virtual void restore(const IntegratorState& state) = 0;
  /// Whether state().error means something.
  virtual bool estimates_errors() const { return false; }
  /// Energy of an error as large as is tolerated, J (per radian or per metre).
  virtual double tolerated_energy(const System& /*system*/) const { return 0.0; }
  /// What to try when a run has become unstable. step: s, the last one.
  virtual std::string advice(const System& system, double step) const = 0;
  /// What to try when a run has lost energy. lost: J (per radian or per metre).
  virtual std::string advice_on_loss(const System& system, double step, double /*lost*/) const {
    return advice(system, step);
  }
};

}  // namespace vitrum
