#pragma once
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>
#include <sunnonlinsol/sunnonlinsol_fixedpoint.h>

#include <cstddef>
#include <memory>
#include <string>

#include "integrators/sundials/context.hpp"
#include "integrators/sundials/owned.hpp"

namespace vitrum::sundials {

/// A small system y' = f(t, y) with roots, as CVODE sees it.
class OdeSystem {
 public:
  virtual ~OdeSystem() = default;
  /// False: not finite (CVODE then tries a shorter step).
  virtual bool rates(double t, const double* y, double* rates) = 0;
  /// Whether d(rates)/dy is known; otherwise CVODE takes difference quotients.
  virtual bool has_jacobian() const = 0;
  /// Fills its columns.
  virtual void jacobian(double t, const double* y, double* columns) = 0;
  /// Fills `CvodeSolver::roots` functions that cross zero upwards where an event happens.
  virtual void roots(double t, const double* y, double* values) = 0;
};

enum class CvodeMethod { bdf, adams };

/// CVODE's memory, vector and dense solver for one number of unknowns and one method, created once and used
/// again. BDF with Newton and a dense matrix, Adams with a fixed-point iteration.
class CvodeSolver {
 public:
  static constexpr int roots = 13;

  /// context must outlive the solver. Throws std::runtime_error when SUNDIALS refuses, std::bad_alloc.
  CvodeSolver(const Context& context, std::size_t size, CvodeMethod method);

  struct Settings {
    double relative;         ///< tolerance
    const double* absolute;  ///< tolerance of each unknown
    double longest_step;
    double first_step;  ///< 0: CVODE's own estimate
    long most_steps;
  };
  struct Result {
    int flag = 0;  ///< CVODE's; negative: failed
    double time = 0.0;
    int root = -1;  ///< index of the root found; -1: the end was reached
    long steps = 0, right_hand_sides = 0;
    bool failed() const { return flag < 0; }
    std::string message() const;
  };
  /// Integrates from t = 0 to `end`, or to the first root. y: in and out.
  Result solve(OdeSystem& system, double* y, double end, const Settings& settings);

 private:
  struct FreeMemory {
    void operator()(void* memory) const { CVodeFree(&memory); }
  };
  /// All root functions, anew.
  void watch_roots();

  bool roots_met_zero_ = false;
  Owned<N_Vector, N_VDestroy> vector_, tolerances_;
  Owned<SUNMatrix, SUNMatDestroy> matrix_;
  Owned<SUNLinearSolver, SUNLinSolFree> linear_;
  Owned<SUNNonlinearSolver, SUNNonlinSolFree> fixed_point_;
  std::unique_ptr<void, FreeMemory> memory_;  // last: freed before what it uses
};

}  // namespace vitrum::sundials
