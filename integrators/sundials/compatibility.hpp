#pragma once
#include <arkode/arkode_arkstep.h>
#include <cvode/cvode.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>
#if SUNDIALS_VERSION_MAJOR >= 7
#include <sunadaptcontroller/sunadaptcontroller_soderlind.h>

#include "integrators/sundials/owned.hpp"
#endif

/// The only place that looks at SUNDIALS_VERSION: what differs between 6.4 and 7.x is given one name here,
/// that of 7 where it has one.
namespace vitrum::sundials {

/// Creates a context without MPI. SUNDIALS 7 takes a communicator handle, SUNDIALS 6 a pointer to one.
inline int create_context(SUNContext* context) {
#if SUNDIALS_VERSION_MAJOR >= 7
  return SUNContext_Create(SUN_COMM_NULL, context);
#else
  return SUNContext_Create(nullptr, context);
#endif
}

#if SUNDIALS_VERSION_MAJOR < 7
// Functions of every stepper of ARKODE in 7 were one per stepper in 6.
#define VITRUM_ARKODE(name) inline constexpr auto ARKode##name = ARKStep##name
VITRUM_ARKODE(Evolve);
VITRUM_ARKODE(Free);
VITRUM_ARKODE(GetCurrentStep);
VITRUM_ARKODE(GetErrWeights);
VITRUM_ARKODE(GetEstLocalErrors);
VITRUM_ARKODE(GetLastStep);
VITRUM_ARKODE(GetNumExpSteps);
VITRUM_ARKODE(GetNumNonlinSolvIters);
VITRUM_ARKODE(GetNumStepAttempts);
VITRUM_ARKODE(GetNumSteps);
VITRUM_ARKODE(SStolerances);
VITRUM_ARKODE(SetCFLFraction);
VITRUM_ARKODE(SetDeltaGammaMax);
VITRUM_ARKODE(SetFixedStep);
VITRUM_ARKODE(SetFixedStepBounds);
VITRUM_ARKODE(SetInitStep);
VITRUM_ARKODE(SetInterpolantDegree);
VITRUM_ARKODE(SetInterpolantType);
VITRUM_ARKODE(SetJacEvalFrequency);
VITRUM_ARKODE(SetLinSysFn);
VITRUM_ARKODE(SetLinearSolver);
VITRUM_ARKODE(SetMaxConvFails);
VITRUM_ARKODE(SetMaxErrTestFails);
VITRUM_ARKODE(SetMaxFirstGrowth);
VITRUM_ARKODE(SetMaxGrowth);
VITRUM_ARKODE(SetMaxHnilWarns);
VITRUM_ARKODE(SetMaxNonlinIters);
VITRUM_ARKODE(SetMaxNumSteps);
VITRUM_ARKODE(SetMaxStep);
VITRUM_ARKODE(SetMinStep);
VITRUM_ARKODE(SetNonlinConvCoef);
VITRUM_ARKODE(SetPreconditioner);
VITRUM_ARKODE(SetSafetyFactor);
VITRUM_ARKODE(SetStabilityFn);
VITRUM_ARKODE(SetStopTime);
VITRUM_ARKODE(SetUserData);
VITRUM_ARKODE(WFtolerances);
#undef VITRUM_ARKODE
#endif

/// What must live as long as ARKODE's memory once `use_pi_controller` has been called.
#if SUNDIALS_VERSION_MAJOR >= 7
using StepController = Owned<SUNAdaptController, SUNAdaptController_Destroy>;
#else
struct StepController {};
#endif

/// ARKODE chooses steps by a PI controller on the order p of the embedding:
/// h' = h (bias e_n)^(-k1/p) (bias e_(n-1))^(k2/p). Throws std::bad_alloc.
[[nodiscard]] inline StepController use_pi_controller(void* arkode, [[maybe_unused]] SUNContext context,
                                                      double k1, double k2, double bias) {
#if SUNDIALS_VERSION_MAJOR >= 7
  StepController controller(allocated(SUNAdaptController_PI(context)));
  SUNAdaptController_SetParams_PI(controller.get(), k1, -k2);  // its exponents are -k1/p, -k2/p
  SUNAdaptController_SetErrorBias(controller.get(), bias);
  ARKodeSetAdaptController(arkode, controller.get());
  return controller;
#else
  double parameters[]{k1, k2, 0.0};
  ARKStepSetAdaptivityMethod(arkode, ARK_ADAPT_PI, SUNFALSE, SUNFALSE, parameters);
  ARKStepSetErrorBias(arkode, bias);
  return {};
#endif
}

/// Keeps CVODE's own messages off the terminal; return values say the same. SUNDIALS 7 reports through the
/// context.
inline void silence_cvode([[maybe_unused]] void* cvode, [[maybe_unused]] SUNContext context) {
#if SUNDIALS_VERSION_MAJOR >= 7
  SUNContext_ClearErrHandlers(context);
#else
  CVodeSetErrHandlerFn(
      cvode, [](int, const char*, const char*, char*, void*) {}, nullptr);
#endif
}

/// The same for ARKODE.
inline void silence_arkode([[maybe_unused]] void* arkode, [[maybe_unused]] SUNContext context) {
#if SUNDIALS_VERSION_MAJOR >= 7
  SUNContext_ClearErrHandlers(context);
#else
  ARKStepSetErrHandlerFn(
      arkode, [](int, const char*, const char*, char*, void*) {}, nullptr);
#endif
}

}  // namespace vitrum::sundials
