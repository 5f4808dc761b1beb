#include <arkode/arkode_arkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include <cmath>
#include <memory>

#include "catch.hpp"
#include "integrators/sundials/context.hpp"
#include "integrators/sundials/owned.hpp"

using vitrum::sundials::Context;
using vitrum::sundials::Owned;

// The build links against SUNDIALS, and a context of ours carries their objects.

namespace {

using Vector = Owned<N_Vector, N_VDestroy>;

int decay(sunrealtype, N_Vector y, N_Vector rate, void*) {
  NV_Ith_S(rate, 0) = -2.0 * NV_Ith_S(y, 0);
  return 0;
}

}  // namespace

TEST_CASE("Contexts are separate and free themselves", "[integrators][sundials]") {
  const Context one, other;
  CHECK(one.get() != nullptr);
  CHECK(one.get() != other.get());
}

TEST_CASE("CVODE integrates a decay in a context of ours", "[integrators][sundials]") {
  const Context context;
  const Vector y(N_VNew_Serial(1, context.get()));
  N_VConst(1.0, y.get());
  const Owned<SUNMatrix, SUNMatDestroy> matrix(SUNDenseMatrix(1, 1, context.get()));
  const Owned<SUNLinearSolver, SUNLinSolFree> solver(SUNLinSol_Dense(y.get(), matrix.get(), context.get()));
  void* memory = CVodeCreate(CV_BDF, context.get());
  REQUIRE(memory != nullptr);
  REQUIRE(CVodeInit(memory, decay, 0.0, y.get()) == CV_SUCCESS);
  REQUIRE(CVodeSStolerances(memory, 1e-8, 1e-12) == CV_SUCCESS);
  REQUIRE(CVodeSetLinearSolver(memory, solver.get(), matrix.get()) == CV_SUCCESS);
  REQUIRE(CVodeSetStopTime(memory, 1.0) == CV_SUCCESS);
  sunrealtype reached = 0.0;
  CHECK(CVode(memory, 2.0, y.get(), &reached, CV_NORMAL) == CV_TSTOP_RETURN);
  CHECK(reached == 1.0);
  CHECK(NV_Ith_S(y.get(), 0) == Approx(std::exp(-2.0)).epsilon(1e-6));
  CVodeFree(&memory);
  CHECK(memory == nullptr);
}

TEST_CASE("ARKODE integrates a decay in a context of ours", "[integrators][sundials]") {
  const Context context;
  const Vector y(N_VNew_Serial(1, context.get()));
  N_VConst(1.0, y.get());
  using namespace vitrum::sundials;  // names of ARKODE 7 under 6
  void* memory = ARKStepCreate(decay, nullptr, 0.0, y.get(), context.get());
  REQUIRE(memory != nullptr);
  REQUIRE(ARKodeSStolerances(memory, 1e-8, 1e-12) == ARK_SUCCESS);
  REQUIRE(ARKodeSetStopTime(memory, 1.0) == ARK_SUCCESS);
  sunrealtype reached = 0.0;
  CHECK(ARKodeEvolve(memory, 2.0, y.get(), &reached, ARK_NORMAL) == ARK_TSTOP_RETURN);
  CHECK(NV_Ith_S(y.get(), 0) == Approx(std::exp(-2.0)).epsilon(1e-6));
  ARKodeFree(&memory);
  CHECK(memory == nullptr);
}
