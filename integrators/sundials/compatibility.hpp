#pragma once
#include <arkode/arkode_arkstep.h>
#include <cvode/cvode.h>
#include <sundials/sundials_config.h>
#include <sundials/sundials_context.h>

/// The only place that looks at SUNDIALS_VERSION: what differs between 6.4 and 7.x is given one name here.
namespace vitrum::sundials {

/// Creates a context without MPI. SUNDIALS 7 takes a communicator handle, SUNDIALS 6 a pointer to one.
inline int create_context(SUNContext* context) {
#if SUNDIALS_VERSION_MAJOR >= 7
  return SUNContext_Create(SUN_COMM_NULL, context);
#else
  return SUNContext_Create(nullptr, context);
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
