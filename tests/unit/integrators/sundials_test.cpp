#include <arkode/arkode_arkstep.h>
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunlinsol/sunlinsol_klu.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include <cmath>
#include <memory>

#include "catch.hpp"
#include "integrators/sundials/context.hpp"
#include "integrators/sundials/owned.hpp"

using vitrum::sundials::Context;
using vitrum::sundials::Owned;

// The build links against SUNDIALS and KLU, and a context of ours carries their objects.

namespace {

using Vector = Owned<N_Vector, N_VDestroy>;

int decay(realtype, N_Vector y, N_Vector rate, void*) {
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
  realtype reached = 0.0;
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
  void* memory = ARKStepCreate(decay, nullptr, 0.0, y.get(), context.get());
  REQUIRE(memory != nullptr);
  REQUIRE(ARKStepSStolerances(memory, 1e-8, 1e-12) == ARK_SUCCESS);
  REQUIRE(ARKStepSetStopTime(memory, 1.0) == ARK_SUCCESS);
  realtype reached = 0.0;
  CHECK(ARKStepEvolve(memory, 2.0, y.get(), &reached, ARK_NORMAL) == ARK_TSTOP_RETURN);
  CHECK(NV_Ith_S(y.get(), 0) == Approx(std::exp(-2.0)).epsilon(1e-6));
  ARKStepFree(&memory);
  CHECK(memory == nullptr);
}

TEST_CASE("KLU solves a small sparse system through SUNDIALS", "[integrators][sundials]") {
  const Context context;
  constexpr sunindextype size = 3;
  // [4 1 0; 1 3 0; 0 2 5], by columns.
  const Owned<SUNMatrix, SUNMatDestroy> matrix(SUNSparseMatrix(size, size, 6, CSC_MAT, context.get()));
  REQUIRE(matrix);
  const sunindextype starts[] = {0, 2, 5, 6}, rows[] = {0, 1, 0, 1, 2, 2};
  const double entries[] = {4.0, 1.0, 1.0, 3.0, 2.0, 5.0};
  std::copy(std::begin(starts), std::end(starts), SM_INDEXPTRS_S(matrix.get()));
  std::copy(std::begin(rows), std::end(rows), SM_INDEXVALS_S(matrix.get()));
  std::copy(std::begin(entries), std::end(entries), SM_DATA_S(matrix.get()));
  const Vector x(N_VNew_Serial(size, context.get())), b(N_VNew_Serial(size, context.get()));
  for (sunindextype i = 0; i < size; ++i) NV_Ith_S(x.get(), i) = static_cast<double>(i + 1);
  REQUIRE(SUNMatMatvec(matrix.get(), x.get(), b.get()) == 0);
  N_VConst(0.0, x.get());
  const Owned<SUNLinearSolver, SUNLinSolFree> solver(SUNLinSol_KLU(x.get(), matrix.get(), context.get()));
  REQUIRE(solver);
  REQUIRE(SUNLinSolInitialize(solver.get()) == 0);
  REQUIRE(SUNLinSolSetup(solver.get(), matrix.get()) == 0);
  REQUIRE(SUNLinSolSolve(solver.get(), matrix.get(), x.get(), b.get(), 0.0) == 0);
  for (sunindextype i = 0; i < size; ++i)
    CHECK(NV_Ith_S(x.get(), i) == Approx(static_cast<double>(i + 1)).epsilon(1e-14));
}
