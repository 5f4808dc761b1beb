#include "integrators/sundials/reduced_solver.hpp"

#include <algorithm>
#include <new>

namespace vitrum::sundials {
namespace {

ReducedSolver& self(SUNLinearSolver solver) {
  return *static_cast<ReducedSolver*>(solver->content);
}

}  // namespace

ReducedSolver::ReducedSolver(const Context& context, ReducibleSystem& system, Kind kind) : system_(system) {
  const SparsePattern& pattern = system.pattern();
  const auto n = static_cast<sunindextype>(pattern.size()),
             entries = static_cast<sunindextype>(pattern.row.size());
  matrix_.reset(allocated(SUNSparseMatrix(n, n, entries, CSC_MAT, context.get())));
  std::copy(pattern.column.begin(), pattern.column.end(), SM_INDEXPTRS_S(matrix_.get()));
  std::copy(pattern.row.begin(), pattern.row.end(), SM_INDEXVALS_S(matrix_.get()));
  reduced_.resize(pattern.size());
  last_solution_.reserve(system.size());  // no allocation where SUNDIALS calls
  if (kind == Kind::factor)
    klu_.emplace(pattern);
  else
    diagonal_.resize(pattern.size());
  interface_.reset(allocated(SUNLinSolNewEmpty(context.get())));
  interface_->content = this;
  interface_->ops->gettype = [](SUNLinearSolver) { return SUNLINEARSOLVER_DIRECT; };
  interface_->ops->getid = [](SUNLinearSolver) { return SUNLINEARSOLVER_CUSTOM; };
  interface_->ops->setup = [](SUNLinearSolver s, SUNMatrix) { return self(s).factor(); };
  interface_->ops->solve = [](SUNLinearSolver s, SUNMatrix, N_Vector x, N_Vector b, sunrealtype) {
    self(s).solve(N_VGetArrayPointer(b), N_VGetArrayPointer(x));
    return 0;
  };
}

ReducedSolver::~ReducedSolver() {
  interface_->content = nullptr;  // SUNLinSolFreeEmpty frees the shell only
}

int ReducedSolver::form(double t, const double* y, double gamma, bool keep) {
  if (!keep && !system_.linearise(t, y)) return 1;
  gamma_ = gamma;
  system_.form(gamma, SM_DATA_S(matrix_.get()));
  return 0;
}

int ReducedSolver::factor() {
  ++factorisations_;
  const double* values = SM_DATA_S(matrix_.get());
  if (klu_) {
    KluFactors::Outcome outcome = KluFactors::Outcome::out_of_memory;
    try {
      outcome = klu_->factor(values);
    } catch (const std::bad_alloc&) {  // SUNDIALS' C functions know no exceptions
    }
    out_of_memory_ = outcome == KluFactors::Outcome::out_of_memory;
    return out_of_memory_ ? -1 : outcome == KluFactors::Outcome::singular ? 1 : 0;
  }
  const SparsePattern& pattern = system_.pattern();
  for (std::size_t j = 0; j < pattern.size(); ++j)
    for (auto k = pattern.column[j]; k < pattern.column[j + 1]; ++k)
      if (pattern.row[static_cast<std::size_t>(k)] == static_cast<std::int64_t>(j)) diagonal_[j] = values[k];
  return 0;
}

void ReducedSolver::solve(const double* b, double* x) {
  double* c = reduced_.data();
  system_.reduce(gamma_, b, c);
  if (klu_)
    klu_->solve(c);
  else
    for (std::size_t j = 0; j < diagonal_.size(); ++j) c[j] = diagonal_[j] > 0.0 ? c[j] / diagonal_[j] : 0.0;
  system_.expand(gamma_, b, c, x);
  std::copy_n(b + system_.size(), system_.integrals(), x + system_.size());  // depend on all, nothing on them
  last_solution_.assign(x, x + system_.size());
}

}  // namespace vitrum::sundials
