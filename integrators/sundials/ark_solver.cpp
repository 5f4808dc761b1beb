#include "integrators/sundials/ark_solver.hpp"

#include <arkode/arkode_arkstep.h>
#include <arkode/arkode_butcher_dirk.h>
#include <sunlinsol/sunlinsol_spgmr.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>

namespace vitrum::sundials {
namespace {

void require(bool good, const char* what) {
  if (!good) throw std::runtime_error(std::string("ARKODE could not be set up: ") + what);
}

constexpr int recoverable = 1, unrecoverable = -1;

}  // namespace

/// What ARKODE calls. No exception may cross its frames: it waits in the solver.
struct ArkSolver::Callbacks {
  static ArkSolver& self(void* solver) { return *static_cast<ArkSolver*>(solver); }

  template <class Call>
  static int guarded(void* solver, Call&& call) {
    try {
      return call();
    } catch (const std::bad_alloc&) {
      self(solver).thrown_ = std::current_exception();
      return unrecoverable;
    } catch (...) {
      self(solver).thrown_ = std::current_exception();
      return recoverable;
    }
  }
  static int rates(sunrealtype t, N_Vector y, N_Vector rates, void* solver) {
    if (self(solver).know_first_stage(rates)) return 0;
    ++self(solver).evaluations_;
    return guarded(solver, [&] {
      return self(solver).system_.rates(t, N_VGetArrayPointer(y), N_VGetArrayPointer(rates)) ? 0
                                                                                             : recoverable;
    });
  }
  static int weights(N_Vector, N_Vector weights, void* solver) {
    self(solver).system_.error_weights(N_VGetArrayPointer(weights));
    return 0;
  }
  static int stability(N_Vector y, sunrealtype t, sunrealtype* step, void* solver) {
    const double stable = self(solver).system_.stable_step(t, N_VGetArrayPointer(y));
    *step = std::isfinite(stable) ? stable : -1.0;  // none
    return 0;
  }
  static int linear_system(sunrealtype t, N_Vector y, N_Vector, SUNMatrix, SUNMatrix, sunbooleantype keep,
                           sunbooleantype* current, sunrealtype gamma, void* solver, N_Vector, N_Vector,
                           N_Vector) {
    *current = keep ? SUNFALSE : SUNTRUE;
    return guarded(solver, [&] {
      return self(solver).reduced_->form(t, N_VGetArrayPointer(y), gamma, keep != SUNFALSE);
    });
  }
  static int precondition_setup(sunrealtype t, N_Vector y, N_Vector, sunbooleantype keep,
                                sunbooleantype* current, sunrealtype gamma, void* solver) {
    *current = keep ? SUNFALSE : SUNTRUE;
    return guarded(solver, [&] {
      const int flag = self(solver).reduced_->form(t, N_VGetArrayPointer(y), gamma, keep != SUNFALSE);
      return flag != 0 ? flag : self(solver).reduced_->factor();
    });
  }
  static int precondition(sunrealtype, N_Vector, N_Vector, N_Vector r, N_Vector z, sunrealtype, sunrealtype,
                          int, void* solver) {
    self(solver).reduced_->solve(N_VGetArrayPointer(r), N_VGetArrayPointer(z));
    return 0;
  }
};

ArkSolver::ArkSolver(const Context& context, const ArkSettings& settings, ArkSystem& system)
    : settings_(settings), system_(system) {
  y_ = make_state_vector(system, context);
  errors_.reset(allocated(N_VClone(y_.get())));
}

ArkSolver::ArkSolver(const Context& context, const ButcherTable& table, const ArkSettings& settings,
                     ArkSystem& system)
    : ArkSolver(context, settings, system) {
  first_same_as_last_ = table.ends_in_solution();
  memory_.reset(allocated(ARKStepCreate(Callbacks::rates, nullptr, 0.0, y_.get(), context.get())));
  create(context, table);
}

ArkSolver::ArkSolver(const Context& context, const ButcherTable& table, const ArkSettings& settings,
                     ReducibleSystem& system, LinearSolverKind linear)
    : ArkSolver(context, settings, static_cast<ArkSystem&>(system)) {
  reducible_ = &system;
  memory_.reset(allocated(ARKStepCreate(nullptr, Callbacks::rates, 0.0, y_.get(), context.get())));
  create(context, table);
  attach_linear_solver(context, linear);
}

void ArkSolver::create(const Context& context, const ButcherTable& table) {
  void* m = memory_.get();
  silence_arkode(m, context.get());
  const bool is_explicit = table.kind == TableKind::explicit_stages;
  const char* none = is_explicit ? "ARKODE_DIRK_NONE" : "ARKODE_ERK_NONE";
  require(ARKStepSetTableName(m, is_explicit ? none : table.name.c_str(),
                              is_explicit ? table.name.c_str() : none) == ARK_SUCCESS,
          "Butcher table");
  require(ARKodeSetUserData(m, this) == ARK_SUCCESS, "user data");
  require(ARKodeWFtolerances(m, Callbacks::weights) == ARK_SUCCESS, "tolerances");
  // At a stop ARKODE 6.4 takes its solution from the interpolant; Lagrange's of degree 0 is that of the last
  // step itself, and needs neither right-hand sides nor earlier states.
  require(ARKodeSetInterpolantType(m, ARK_INTERP_LAGRANGE) == ARK_SUCCESS &&
              ARKodeSetInterpolantDegree(m, 0) == ARK_SUCCESS,
          "interpolation");
  ARKodeSetMaxNumSteps(m, -1);
  ARKodeSetMaxHnilWarns(m, -1);
  if (settings_.fixed_step) return;
  // With ARKODE's own parameters.
  controller_ = use_pi_controller(m, context.get(), 0.8, 0.31, settings_.bias);
  ARKodeSetSafetyFactor(m, settings_.safety);
  ARKodeSetMaxGrowth(m, settings_.growth);
  ARKodeSetMaxFirstGrowth(m, settings_.growth);
  ARKodeSetFixedStepBounds(m, 1.0, settings_.keep_up_to);
  ARKodeSetCFLFraction(m, settings_.stable_part);
  ARKodeSetStabilityFn(m, Callbacks::stability, this);
  ARKodeSetMaxErrTestFails(m, 100);  // the shortest step ends them
  ARKodeSetMinStep(m, settings_.shortest_step);
  if (std::isfinite(settings_.longest_step)) ARKodeSetMaxStep(m, settings_.longest_step);
}

void ArkSolver::attach_linear_solver(const Context& context, LinearSolverKind linear) {
  void* m = memory_.get();
  const bool direct = linear == LinearSolverKind::klu;
  reduced_ = std::make_unique<ReducedSolver>(context, *reducible_,
                                             linear == LinearSolverKind::gmres_with_diagonal
                                                 ? ReducedSolver::Kind::diagonal
                                                 : ReducedSolver::Kind::factor);
  if (direct) {
    require(ARKodeSetLinearSolver(m, reduced_->interface(), reduced_->matrix()) == 0, "linear solver");
    require(ARKodeSetLinSysFn(m, Callbacks::linear_system) == 0, "linear system");
    // A linearisation of a step before is no longer that of glass that cracks: which particles crack would
    // be decided by what Newton's iteration leaves.
    ARKodeSetJacEvalFrequency(m, 1);
  } else {
    constexpr int krylov_vectors = 60;
    krylov_.reset(allocated(SUNLinSol_SPGMR(y_.get(), SUN_PREC_RIGHT, krylov_vectors, context.get())));
    require(ARKodeSetLinearSolver(m, krylov_.get(), nullptr) == 0, "linear solver");
    require(ARKodeSetPreconditioner(m, Callbacks::precondition_setup, Callbacks::precondition) == 0,
            "preconditioner");
  }
  // A matrix for another gamma leaves an error in what is stiff, which the norm (of nodes with next to no
  // mass, say) need not see: with ARKODE's own 0.2 a tolerance of 1e-6 gave errors of 3e-4.
  ARKodeSetDeltaGammaMax(m, 1e-3);
  ARKodeSetMaxNonlinIters(m, settings_.newton_iterations);
  ARKodeSetNonlinConvCoef(m, settings_.newton_part);
  ARKodeSetMaxConvFails(m, 100);  // the shortest step ends them
}

void ArkSolver::start(double t, double first_step) {
  time_ = t;
  const double stable = settings_.fixed_step ? std::numeric_limits<double>::infinity()
                                             : settings_.stable_part * system_.stable_step(t, y());
  planned_limit_ = first_step < stable ? Limit::accuracy : Limit::stability;
  natural_step_ = 0.0;
  restart(std::min(first_step, stable));
}

/// Explicit methods: whether `rates` are those of the first stage, and known already.
bool ArkSolver::know_first_stage(N_Vector rates) {
  if (reducible_ != nullptr) return false;
  if (first_stage_ == nullptr) first_stage_ = rates;  // the first call after an initialisation
  if (rates != first_stage_) {
    last_stage_ = rates;
    return false;
  }
  if (!first_is_known_ && last_is_known_) N_VScale(1.0, last_stage_, rates);
  const bool known = first_is_known_ || last_is_known_;
  first_is_known_ = true;
  return known;
}

void ArkSolver::set_fixed_step(double step) {
  settings_.fixed_step = step;
  ARKodeSetFixedStep(memory_.get(), step);
}

void ArkSolver::set_shortest_step(double step) {
  settings_.shortest_step = step;
  ARKodeSetMinStep(memory_.get(), step);
}

/// ARKODE begins anew at the state and time reached.
void ArkSolver::restart(double first_step) {
  void* m = memory_.get();
  harvest();
  require((reducible_ ? ARKStepReInit(m, nullptr, Callbacks::rates, time_, y_.get())
                      : ARKStepReInit(m, Callbacks::rates, nullptr, time_, y_.get())) == ARK_SUCCESS,
          "initialisation");
  stable_steps_ = 0;
  first_stage_ = nullptr;
  first_is_known_ = last_is_known_ = false;
  next_step_ = settings_.fixed_step.value_or(first_step);
  if (settings_.fixed_step)
    ARKodeSetFixedStep(m, *settings_.fixed_step);
  else
    ARKodeSetInitStep(m, first_step);
}

auto ArkSolver::step(double stop) -> Step {
  void* m = memory_.get();
  thrown_ = nullptr;
  while (true) {
    Step result;
    sunrealtype reached = time_;
    ARKodeSetStopTime(m, stop);
    const int flag = ARKodeEvolve(m, stop, y_.get(), &reached, ARK_ONE_STEP);
    sunrealtype length = 0.0;
    if (flag >= 0) {
      time_ = result.time = reached;
      first_is_known_ = false, last_is_known_ = first_same_as_last_;
      ARKodeGetLastStep(m, &length);
      result.length = length;
      result.limit = flag == ARK_TSTOP_RETURN ? Limit::stop : planned_limit_;
      if (flag != ARK_TSTOP_RETURN) natural_step_ = length;
      long stable = 0;
      ARKodeGetNumExpSteps(m, &stable);
      planned_limit_ = stable > stable_steps_ ? Limit::stability : Limit::accuracy;
      stable_steps_ = stable;
      sunrealtype next = 0.0;
      ARKodeGetCurrentStep(m, &next);
      next_step_ = std::max<double>(next, natural_step_);
      return result;
    }
    if (flag == ARK_MEM_FAIL || (reduced_ && reduced_->out_of_memory())) throw std::bad_alloc();
    result.time = time_;
    ARKodeGetCurrentStep(m, &length);
    result.length = length;
    const bool rates_failed = flag == ARK_UNREC_RHSFUNC_ERR || flag == ARK_REPTD_RHSFUNC_ERR;
    result.failure = flag == ARK_ERR_FAILURE                               ? Failure::error_test
                     : flag == ARK_CONV_FAILURE || flag == ARK_LSETUP_FAIL ? Failure::newton
                                                                           : Failure::rates;
    // ARKODE gives up where an explicit stage cannot be evaluated; a shorter step may be able to.
    const double shorter = 0.25 * length;
    if (!rates_failed || settings_.fixed_step || !(shorter >= settings_.shortest_step) ||
        !(time_ + shorter > time_)) {
      if (thrown_) std::rethrow_exception(thrown_);
      return result;
    }
    thrown_ = nullptr;
    restart(shorter);
  }
}

const double* ArkSolver::local_errors() {
  ARKodeGetEstLocalErrors(memory_.get(), errors_.get());
  return N_VGetArrayPointer(errors_.get());
}

const double* ArkSolver::weights() {
  if (!weights_) weights_.reset(allocated(N_VClone(y_.get())));
  ARKodeGetErrWeights(memory_.get(), weights_.get());
  return N_VGetArrayPointer(weights_.get());
}

/// ARKODE's counters begin anew with each initialisation.
void ArkSolver::harvest() {
  total_ = counters();
}

auto ArkSolver::counters() const -> Counters {
  void* m = memory_.get();
  Counters c = total_;
  long n = 0;
  c.right_hand_sides = evaluations_;
  ARKodeGetNumStepAttempts(m, &n), c.attempts += n;
  ARKodeGetNumSteps(m, &n), c.steps += n;
  if (reducible_) ARKodeGetNumNonlinSolvIters(m, &n), c.newton_iterations += n;
  if (reduced_) c.factorisations = reduced_->factorisations(), c.factor_entries = reduced_->factor_entries();
  return c;
}

}  // namespace vitrum::sundials
