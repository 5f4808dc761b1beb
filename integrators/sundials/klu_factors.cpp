#include "integrators/sundials/klu_factors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

namespace vitrum::sundials {

KluFactors::KluFactors(const SparsePattern& pattern)
    : column_(pattern.column.begin(), pattern.column.end()), row_(pattern.row.begin(), pattern.row.end()) {
  if (pattern.row.size() > static_cast<std::size_t>(std::numeric_limits<int>::max())) throw std::bad_alloc();
  klu_defaults(&common_);
  // Blocks of a triangle there are none to find; the search would move rows off the diagonal, and with them
  // the pattern out of its symmetry: four times the entries in the factors of 10,432 unknowns.
  common_.btf = 0;
  common_.ordering = 0;  // AMD, minimum degree: the pattern is symmetric
  symbolic_ = klu_analyze(static_cast<int>(pattern.size()), column_.data(), row_.data(), &common_);
  if (symbolic_ == nullptr) throw std::bad_alloc();
}

KluFactors::~KluFactors() {
  klu_free_numeric(&numeric_, &common_);
  klu_free_symbolic(&symbolic_, &common_);
}

/// Whether the pivots of the last factorisation do for these values.
bool KluFactors::refactor(double* values) {
  static const double least =
      std::cbrt(std::numeric_limits<double>::epsilon() * std::numeric_limits<double>::epsilon());
  return klu_refactor(column_.data(), row_.data(), values, symbolic_, numeric_, &common_) != 0 &&
         klu_rcond(symbolic_, numeric_, &common_) != 0 && common_.rcond >= least;
}

KluFactors::Outcome KluFactors::factor(const double* constant) {
  auto* values = const_cast<double*>(constant);  // KLU reads them only
  if (numeric_ != nullptr && refactor(values)) {
    take_apart();
    return Outcome::done;
  }
  klu_free_numeric(&numeric_, &common_);
  numeric_ = klu_factor(column_.data(), row_.data(), values, symbolic_, &common_);
  if (numeric_ != nullptr && common_.status == KLU_OK) {
    take_apart();
    return Outcome::done;
  }
  const bool too_large = common_.status == KLU_OUT_OF_MEMORY || common_.status == KLU_TOO_LARGE;
  klu_free_numeric(&numeric_, &common_);
  return too_large ? Outcome::out_of_memory : Outcome::singular;
}

void KluFactors::take_apart() {
  const auto n = static_cast<std::size_t>(symbolic_->n);
  lower_.resize(n, static_cast<std::size_t>(numeric_->lnz));
  upper_.resize(n, static_cast<std::size_t>(numeric_->unz));
  row_order_.resize(n), column_order_.resize(n), scale_.resize(n), solution_.resize(n);
  klu_extract(numeric_, symbolic_, lower_.start.data(), lower_.row.data(), lower_.value.data(),
              upper_.start.data(), upper_.row.data(), upper_.value.data(), nullptr, nullptr, nullptr,
              row_order_.data(), column_order_.data(), scale_.data(), nullptr, &common_);
  std::reverse(upper_.row.begin(), upper_.row.end());
  std::reverse(upper_.value.begin(), upper_.value.end());
  std::reverse(upper_.start.begin(), upper_.start.end());
  for (int& start : upper_.start) start = numeric_->unz - start;
}

void KluFactors::solve(double* b) {
  const std::size_t n = solution_.size();
  double* x = solution_.data();
  for (std::size_t k = 0; k < n; ++k) x[k] = b[row_order_[k]] / scale_[k];
  const auto eliminate = [x](const Triangle& t, std::size_t column, double by) {
    for (auto k = static_cast<std::size_t>(t.start[column]) + 1;
         k < static_cast<std::size_t>(t.start[column + 1]); ++k)
      x[t.row[k]] -= t.value[k] * by;
  };
  for (std::size_t k = 0; k < n; ++k) eliminate(lower_, k, x[k]);
  for (std::size_t k = 0; k < n; ++k) {
    double& unknown = x[n - 1 - k];
    unknown /= upper_.value[static_cast<std::size_t>(upper_.start[k])];
    eliminate(upper_, k, unknown);
  }
  for (std::size_t k = 0; k < n; ++k) b[column_order_[k]] = x[k];
}

std::int64_t KluFactors::entries() const {
  return numeric_ == nullptr ? 0 : std::int64_t{numeric_->lnz} + std::int64_t{numeric_->unz};
}

}  // namespace vitrum::sundials
