#pragma once
#include <klu.h>

#include <cstdint>
#include <vector>

#include "integrators/sundials/ark_system.hpp"

namespace vitrum::sundials {

/// KLU's factors of matrices that have one pattern. Solving waits for them to come from memory, so they are
/// kept small and in the order in which substitution reads them: indices have 32 bits (in SUNDIALS' own
/// interface to KLU the 64 of its index type), and KLU's columns, which alternate between both factors, are
/// taken apart.
class KluFactors {
 public:
  enum class Outcome { done, singular, out_of_memory };

  /// Throws std::bad_alloc, also for more entries than 32 bits count.
  explicit KluFactors(const SparsePattern& pattern);
  ~KluFactors();
  KluFactors(const KluFactors&) = delete;
  KluFactors& operator=(const KluFactors&) = delete;

  /// Factors the matrix with these values, in the order of the pattern: with the last pivots where they
  /// serve, with new ones otherwise.
  Outcome factor(const double* values);
  /// Replaces the right-hand side b by the solution. After a `factor` that was done.
  void solve(double* b);
  /// Entries of both factors; 0 before the first.
  std::int64_t entries() const;

 private:
  /// Columns of a triangular factor: column k has the entries [start[k], start[k + 1]).
  struct Triangle {
    std::vector<int> start, row;
    std::vector<double> value;

    void resize(std::size_t columns, std::size_t entries) {
      start.resize(columns + 1), row.resize(entries), value.resize(entries);
    }
  };

  bool refactor(double* values);
  void take_apart();

  std::vector<int> column_, row_;
  klu_common common_;
  klu_symbolic* symbolic_ = nullptr;
  klu_numeric* numeric_ = nullptr;
  // Of the matrix with its rows divided by scale_ and put in the order row_order_, its columns in the order
  // column_order_. The diagonal comes first in the columns of lower_ (ones) and of upper_.
  Triangle lower_;
  Triangle upper_;  ///< from the last column to the first
  std::vector<int> row_order_, column_order_;
  std::vector<double> scale_, solution_;
};

}  // namespace vitrum::sundials
