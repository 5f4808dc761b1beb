#include "integrators/sundials/reduced_solver.hpp"

#include <algorithm>
#include <cmath>

namespace vitrum::sundials {
namespace {

ReducedSolver& self(SUNLinearSolver solver) {
  return *static_cast<ReducedSolver*>(solver->content);
}

}  // namespace

ReducedSolver::ReducedSolver(const Context& context, ReducibleSystem& system, Kind kind)
    : system_(system), kind_(kind) {
  const SparsePattern& pattern = system.pattern();
  const auto n = static_cast<sunindextype>(pattern.size()),
             entries = static_cast<sunindextype>(pattern.row.size());
  matrix_.reset(allocated(SUNSparseMatrix(n, n, entries, CSC_MAT, context.get())));
  std::copy(pattern.column.begin(), pattern.column.end(), SM_INDEXPTRS_S(matrix_.get()));
  std::copy(pattern.row.begin(), pattern.row.end(), SM_INDEXVALS_S(matrix_.get()));
  right_.reset(allocated(N_VNew_Serial(n, context.get())));
  solution_.reset(allocated(N_VNew_Serial(n, context.get())));
  last_solution_.reserve(system.size());  // no allocation where SUNDIALS calls
  if (kind_ == Kind::factor) {
    klu_.reset(allocated(SUNLinSol_KLU(right_.get(), matrix_.get(), context.get())));
    constexpr int minimum_degree = 0;  // AMD: the pattern is symmetric
    SUNLinSol_KLUSetOrdering(klu_.get(), minimum_degree);
    // Blocks of a triangle there are none to find; the search would move rows off the diagonal, and with them
    // the pattern out of its symmetry: four times the entries in the factors of 10,432 unknowns.
    SUNLinSol_KLUGetCommon(klu_.get())->btf = 0;
  } else {
    diagonal_.resize(pattern.size());
  }
  interface_.reset(allocated(SUNLinSolNewEmpty(context.get())));
  interface_->content = this;
  interface_->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  interface_->ops->getid = [](SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; };
  interface_->ops->setup = [](SUNLinearSolver s, SUNMatrix) { return self(s).factor(); };
  interface_->ops->solve = [](SUNLinearSolver s, SUNMatrix, N_Vector x, N_Vector b, sunrealtype) {
    return self(s).solve(N_VGetArrayPointer(b), N_VGetArrayPointer(x));
  };
}

ReducedSolver::~ReducedSolver() {
  interface_->content = nullptr;  // SUNLinSolFreeEmpty frees the shell only
}

bool ReducedSolver::out_of_memory() const {
  return klu_ && SUNLinSol_KLUGetCommon(klu_.get())->status == KLU_OUT_OF_MEMORY;
}

std::int64_t ReducedSolver::factor_entries() const {
  const auto* factors = klu_ ? SUNLinSol_KLUGetNumeric(klu_.get()) : nullptr;
  return factors == nullptr ? 0 : std::int64_t{factors->lnz} + std::int64_t{factors->unz};
}

int ReducedSolver::form(double t, const double* y, double gamma, bool keep) {
  if (!keep && !system_.linearise(t, y)) return 1;
  gamma_ = gamma;
  system_.form(gamma, SM_DATA_S(matrix_.get()));
  return 0;
}

int ReducedSolver::factor() {
  ++factorisations_;
  if (klu_) {
    const int flag = SUNLinSolSetup(klu_.get(), matrix_.get());
    if (flag == SUNLS_SUCCESS) return flag;
    // The pivots of the last factorisation may not do for another gamma: choose them anew.
    SUNLinSol_KLUReInit(klu_.get(), matrix_.get(), SM_NNZ_S(matrix_.get()), SUNKLU_REINIT_PARTIAL);
    return SUNLinSolSetup(klu_.get(), matrix_.get());
  }
  const SparsePattern& pattern = system_.pattern();
  const double* values = SM_DATA_S(matrix_.get());
  for (std::size_t j = 0; j < pattern.size(); ++j)
    for (auto k = pattern.column[j]; k < pattern.column[j + 1]; ++k)
      if (pattern.row[static_cast<std::size_t>(k)] == static_cast<std::int64_t>(j)) diagonal_[j] = values[k];
  return SUNLS_SUCCESS;
}

int ReducedSolver::solve(const double* b, double* x) {
  double* c = N_VGetArrayPointer(right_.get());
  double* z = N_VGetArrayPointer(solution_.get());
  system_.reduce(gamma_, b, c);
  if (klu_) {
    const int flag = SUNLinSolSolve(klu_.get(), matrix_.get(), solution_.get(), right_.get(), 0.0);
    if (flag != SUNLS_SUCCESS) return flag;
  } else {
    for (std::size_t j = 0; j < diagonal_.size(); ++j) z[j] = diagonal_[j] > 0.0 ? c[j] / diagonal_[j] : 0.0;
  }
  system_.expand(gamma_, b, z, x);
  last_solution_.assign(x, x + system_.size());
  return SUNLS_SUCCESS;
}

}  // namespace vitrum::sundials
