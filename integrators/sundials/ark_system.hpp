#pragma once
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <vector>

namespace vitrum::sundials {

/// A large system y' = f(t, y) as ARKODE sees it.
class ArkSystem {
 public:
  virtual ~ArkSystem() = default;
  /// Number of unknowns.
  virtual std::size_t size() const = 0;
  /// Integrals over time on which nothing depends: they stand behind the unknowns in y and in their rates,
  /// and have no part in errors, tolerances and Newton's equations.
  virtual std::size_t integrals() const { return 0; }
  /// False, or an exception: cannot be evaluated here; ARKODE then tries a shorter step. An exception reaches
  /// the caller of ArkSolver::step when no shorter step helps.
  virtual bool rates(double t, const double* y, double* rates) = 0;
  /// 1 / (what counts as an error of one) for every component; asked for before every step.
  virtual void error_weights(double* weights) const = 0;
  /// The longest stable step at y, s.
  virtual double stable_step(double /*t*/, const double* /*y*/) {
    return std::numeric_limits<double>::infinity();
  }

  /// What is done with vectors of unknowns is done in so many parts, the same for any number of threads.
  virtual std::size_t parts() const { return 1; }
  using RangeTask = void (*)(void* context, std::size_t part, std::size_t begin, std::size_t end);
  /// Calls task(context, part, begin, end) for ranges of unknowns (not of integrals) that together are all of
  /// them; those of a part one after the other, always in the same order, on one thread.
  virtual void for_ranges(RangeTask task, void* context) const { task(context, 0, 0, size()); }
  /// The same for f(part, begin, end).
  template <class F>
  void for_each_range(F&& f) const {
    for_ranges(
        [](void* context, std::size_t part, std::size_t begin, std::size_t end) {
          (*static_cast<std::remove_reference_t<F>*>(context))(part, begin, end);
        },
        &f);
  }
};

/// Compressed columns of a square sparse matrix.
struct SparsePattern {
  std::vector<std::int64_t> column;  ///< start of each column in `row`, and the end of the last
  std::vector<std::int64_t> row;

  std::size_t size() const { return column.empty() ? 0 : column.size() - 1; }
  friend bool operator==(const SparsePattern&, const SparsePattern&) = default;
};

/// A system whose Newton equations (I - gamma J) x = b reduce to a smaller sparse system A z = c.
class ReducibleSystem : public ArkSystem {
 public:
  virtual const SparsePattern& pattern() const = 0;
  /// Evaluates what A depends on besides gamma at (t, y). False: not finite.
  virtual bool linearise(double t, const double* y) = 0;
  /// Values of A for gamma, in the order of the pattern.
  virtual void form(double gamma, double* values) const = 0;
  /// c from b; b may be changed.
  virtual void reduce(double gamma, const double* b, double* c) const = 0;
  /// x from b and z.
  virtual void expand(double gamma, const double* b, const double* z, double* x) const = 0;
};

}  // namespace vitrum::sundials
