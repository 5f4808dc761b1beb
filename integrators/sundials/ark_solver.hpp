#pragma once
#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <string>

#include "integrators/sundials/ark_system.hpp"
#include "integrators/sundials/butcher_table.hpp"
#include "integrators/sundials/context.hpp"
#include "integrators/sundials/reduced_solver.hpp"
#include "integrators/sundials/state_vector.hpp"

namespace vitrum::sundials {

/// What ARKODE is told besides the system. Everything that its versions set differently is set here.
struct ArkSettings {
  std::optional<double> fixed_step;  ///< s; no adaptivity, no error estimate
  double shortest_step = 0.0, longest_step = std::numeric_limits<double>::infinity();  ///< s
  double safety = 0.9;        ///< of what the controller proposes
  double bias = 1.2;          ///< the controller sees the error times this
  double growth = 5.0;        ///< most from one step to the next
  double stable_part = 0.95;  ///< of the longest stable step
  double keep_up_to = 1.0;    ///< a proposed growth below this leaves the step as it is
  int newton_iterations = 5;
  double newton_part = 0.03;  ///< of the tolerance, that the iteration may leave
};

enum class LinearSolverKind { klu, gmres_with_factor, gmres_with_diagonal };

/// ARKODE's ARKStep for one system, one Butcher table; steps one at a time, so that the caller commits each.
/// (ARKStep also for explicit tables: ERKStep of SUNDIALS 6.4 takes the rate of the last stage for that at
/// the end of the step whenever c_s = 1, also where the last stage is not the solution. ARKStep in turn
/// evaluates the first stage of every attempt; here it is known from the attempt before, or from the last
/// stage where that is the solution.)
class ArkSolver {
 public:
  /// Explicit. context and system must outlive the solver. Throws std::runtime_error when SUNDIALS refuses,
  /// std::bad_alloc.
  ArkSolver(const Context& context, const ButcherTable& table, const ArkSettings& settings,
            ArkSystem& system);
  /// Diagonally implicit, with Newton's method.
  ArkSolver(const Context& context, const ButcherTable& table, const ArkSettings& settings,
            ReducibleSystem& system, LinearSolverKind linear);

  /// The state: in before `start`, out after `step`.
  double* y() { return N_VGetArrayPointer(y_.get()); }
  std::size_t size() const { return static_cast<std::size_t>(N_VGetLength(y_.get())); }

  /// Changes what the settings said, from the next step (s) on.
  void set_fixed_step(double step);
  void set_shortest_step(double step);

  /// Begins at y() with a first step (s) that may be cut to the stable one.
  void start(double t, double first_step);

  enum class Limit { accuracy, stability, stop };
  enum class Failure { none, error_test, newton, rates };
  struct Step {
    Failure failure = Failure::none;
    double time = 0.0;    ///< reached; s
    double length = 0.0;  ///< of the step taken, or of the last attempt; s
    Limit limit = Limit::accuracy;
  };
  /// One step, not beyond `stop`. Failure: no step down to the shortest was accepted, and y() is as before.
  Step step(double stop);

  /// Step that ARKODE would take next (not cut by the stop), s.
  double next_step() const { return next_step_; }
  /// Estimated error of the last attempted step, and the weights it is judged with. Not with a fixed step.
  const double* local_errors();
  const double* weights();
  /// What the linear solver gave last (the correction of the last Newton iteration); empty before.
  const std::vector<double>& last_correction() const { return reduced_->last_solution(); }

  struct Counters {
    std::int64_t attempts = 0, steps = 0, right_hand_sides = 0, newton_iterations = 0, factorisations = 0;
    std::int64_t factor_entries = 0;  ///< of the factors at hand
  };
  /// Work since construction.
  Counters counters() const;

 private:
  struct Callbacks;
  struct FreeMemory {
    void operator()(void* memory) const { ARKodeFree(&memory); }
  };
  ArkSolver(const Context& context, const ArkSettings& settings, ArkSystem& system);
  void create(const Context& context, const ButcherTable& table);
  void attach_linear_solver(const Context& context, LinearSolverKind linear);
  void restart(double first_step);
  void harvest();
  bool know_first_stage(N_Vector rates);

  ArkSettings settings_;
  ArkSystem& system_;
  ReducibleSystem* reducible_ = nullptr;
  StateVector y_, errors_;
  StateVector weights_;  // once asked for
  std::unique_ptr<ReducedSolver> reduced_;
  Owned<SUNLinearSolver, SUNLinSolFree> krylov_;
  StepController controller_;
  std::unique_ptr<void, FreeMemory> memory_;  // after what it uses: freed before
  std::exception_ptr thrown_;
  bool first_same_as_last_ = false;
  N_Vector first_stage_ = nullptr, last_stage_ = nullptr;  // ARKODE's rates of explicit stages
  bool first_is_known_ = false, last_is_known_ = false;    // for the step at hand
  std::int64_t evaluations_ = 0;
  double time_ = 0.0, next_step_ = 0.0, natural_step_ = 0.0;
  Limit planned_limit_ = Limit::accuracy;
  long stable_steps_ = 0;  // of ARKODE's count, seen so far
  Counters total_;
};

}  // namespace vitrum::sundials
