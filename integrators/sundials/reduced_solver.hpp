#pragma once
#include <nvector/nvector_serial.h>
#include <sundials/sundials_linearsolver.h>
#include <sunmatrix/sunmatrix_sparse.h>

#include <cstdint>
#include <optional>

#include "integrators/sundials/ark_system.hpp"
#include "integrators/sundials/context.hpp"
#include "integrators/sundials/klu_factors.hpp"
#include "integrators/sundials/owned.hpp"

namespace vitrum::sundials {

/// Solves the reduced Newton equations of a system by KLU's factors, or divides by the diagonal. Serves
/// ARKODE as its linear solver (`interface`) or as a preconditioner of GMRES.
class ReducedSolver {
 public:
  enum class Kind { factor, diagonal };
  /// system and context must outlive the solver. Throws std::bad_alloc.
  ReducedSolver(const Context& context, ReducibleSystem& system, Kind kind);
  ~ReducedSolver();
  ReducedSolver(const ReducedSolver&) = delete;
  ReducedSolver& operator=(const ReducedSolver&) = delete;

  /// Forms A for gamma, after linearising at (t, y) unless `keep`. 0: done; 1: not finite.
  int form(double t, const double* y, double gamma, bool keep);
  /// Factors what `form` made. As SUNDIALS wants it: 0: done; > 0: another step may do; < 0: none will.
  int factor();
  /// Approximates the solution of (I - gamma J) x = b with the gamma of the last `form`.
  void solve(const double* b, double* x);

  /// The solver as SUNDIALS sees it, with the matrix it belongs to.
  SUNLinearSolver interface() const { return interface_.get(); }
  SUNMatrix matrix() const { return matrix_.get(); }
  /// Whether the last factorisation failed for want of memory.
  bool out_of_memory() const { return out_of_memory_; }
  std::int64_t factorisations() const { return factorisations_; }
  /// Entries of both factors (KLU); 0 before the first.
  std::int64_t factor_entries() const { return klu_ ? klu_->entries() : 0; }
  const std::vector<double>& last_solution() const { return last_solution_; }

 private:
  ReducibleSystem& system_;
  double gamma_ = 0.0;
  std::int64_t factorisations_ = 0;
  Owned<SUNMatrix, SUNMatDestroy> matrix_;
  std::optional<KluFactors> klu_;  // none: the diagonal
  bool out_of_memory_ = false;
  Owned<SUNLinearSolver, SUNLinSolFreeEmpty> interface_;
  std::vector<double> diagonal_, reduced_, last_solution_;
};

}  // namespace vitrum::sundials
