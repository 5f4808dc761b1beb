#include "integrators/sundials/cvode_solver.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <stdexcept>

namespace vitrum::sundials {
namespace {

/// What CVODE hands back to its callbacks.
struct Callbacks {
  OdeSystem& system;
  bool& met_zero;
};
OdeSystem& system_of(void* callbacks) {
  return static_cast<Callbacks*>(callbacks)->system;
}

int right_hand_side(sunrealtype t, N_Vector y, N_Vector rates, void* callbacks) {
  const bool finite = system_of(callbacks).rates(t, N_VGetArrayPointer(y), N_VGetArrayPointer(rates));
  return finite ? 0 : 1;
}

int jacobian(sunrealtype t, N_Vector y, N_Vector, SUNMatrix J, void* callbacks, N_Vector, N_Vector,
             N_Vector) {
  system_of(callbacks).jacobian(t, N_VGetArrayPointer(y), SUNDenseMatrix_Data(J));
  return 0;
}

int root_functions(sunrealtype t, N_Vector y, sunrealtype* values, void* callbacks) {
  system_of(callbacks).roots(t, N_VGetArrayPointer(y), values);
  if (std::find(values, values + CvodeSolver::roots, 0.0) != values + CvodeSolver::roots)
    static_cast<Callbacks*>(callbacks)->met_zero = true;
  return 0;
}

void require(bool good, const char* what) {
  if (!good) throw std::runtime_error(std::string("CVODE could not be set up: ") + what);
}

}  // namespace

CvodeSolver::CvodeSolver(const Context& context, std::size_t size, CvodeMethod method) {
  const auto n = static_cast<sunindextype>(size);
  vector_.reset(allocated(N_VNew_Serial(n, context.get())));
  N_VConst(0.0, vector_.get());
  tolerances_.reset(allocated(N_VClone(vector_.get())));
  memory_.reset(allocated(CVodeCreate(method == CvodeMethod::bdf ? CV_BDF : CV_ADAMS, context.get())));
  void* m = memory_.get();
  silence_cvode(m, context.get());
  require(CVodeInit(m, right_hand_side, 0.0, vector_.get()) == CV_SUCCESS, "initialisation");
  require(CVodeSStolerances(m, 1e-6, 1e-9) == CV_SUCCESS, "tolerances");
  if (method == CvodeMethod::bdf) {
    matrix_.reset(allocated(SUNDenseMatrix(n, n, context.get())));
    linear_.reset(allocated(SUNLinSol_Dense(vector_.get(), matrix_.get(), context.get())));
    require(CVodeSetLinearSolver(m, linear_.get(), matrix_.get()) == 0, "linear solver");
  } else {
    fixed_point_.reset(allocated(SUNNonlinSol_FixedPoint(vector_.get(), 0, context.get())));
    require(CVodeSetNonlinearSolver(m, fixed_point_.get()) == 0, "nonlinear solver");
  }
  watch_roots();
  CVodeSetNoInactiveRootWarn(m);
}

void CvodeSolver::watch_roots() {
  void* m = memory_.get();
  CVodeRootInit(m, 0, nullptr);
  if (CVodeRootInit(m, roots, root_functions) != CV_SUCCESS) throw std::bad_alloc();
  std::array<int, roots> upwards{};
  upwards.fill(1);
  CVodeSetRootDirection(m, upwards.data());
  roots_met_zero_ = false;
}

auto CvodeSolver::solve(OdeSystem& system, double* y, double end, const Settings& settings) -> Result {
  void* m = memory_.get();
  N_Vector v = vector_.get();
  double* data = N_VGetArrayPointer(v);
  const auto n = static_cast<std::size_t>(N_VGetLength(v));
  std::copy(y, y + n, data);
  Result result;
  // CVODE takes a function that begins at zero, and stays there, off the watch, and ReInit does not put it
  // back: it would miss a root in the first step.
  if (roots_met_zero_) watch_roots();
  Callbacks callbacks{system, roots_met_zero_};
  CVodeSetUserData(m, &callbacks);
  result.flag = CVodeReInit(m, 0.0, v);
  if (result.failed()) return result;
  std::copy(settings.absolute, settings.absolute + n, N_VGetArrayPointer(tolerances_.get()));
  CVodeSVtolerances(m, settings.relative, tolerances_.get());
  if (linear_) CVodeSetJacFn(m, system.has_jacobian() ? jacobian : nullptr);
  CVodeSetMaxNumSteps(m, settings.most_steps);
  CVodeSetMaxStep(m, settings.longest_step);
  CVodeSetInitStep(m, settings.first_step);
  CVodeSetStopTime(m, end);  // anew after every ReInit: a stale one survives a root
  sunrealtype reached = 0.0;
  result.flag = CVode(m, end, v, &reached, CV_NORMAL);
  if (result.flag == CV_MEM_FAIL) throw std::bad_alloc();
  result.time = reached;
  CVodeGetNumSteps(m, &result.steps);
  long of_linear = 0;
  CVodeGetNumRhsEvals(m, &result.right_hand_sides);
  if (linear_ && CVodeGetNumLinRhsEvals(m, &of_linear) == 0) result.right_hand_sides += of_linear;
  if (result.failed()) return result;
  if (result.flag == CV_ROOT_RETURN) {
    std::array<int, roots> found{};
    CVodeGetRootInfo(m, found.data());
    for (int k = 0; k < roots && result.root < 0; ++k)
      if (found[static_cast<std::size_t>(k)] != 0) result.root = k;
  }
  std::copy(data, data + n, y);
  return result;
}

std::string CvodeSolver::Result::message() const {
  const std::unique_ptr<char, decltype(&std::free)> name(CVodeGetReturnFlagName(flag), &std::free);
  return name ? name.get() : "unknown";
}

}  // namespace vitrum::sundials
