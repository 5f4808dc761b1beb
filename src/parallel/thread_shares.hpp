#pragma once
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

namespace vitrum::parallel {

/// Divides a row of pieces of work among threads, each a range of it, in proportion to how fast the threads
/// were before: processors are not equally fast where others use their caches, and not all work costs the
/// same. Only who computes what depends on it.
class ThreadShares {
 public:
  /// work_before(piece): the work of all pieces before, for piece in [0, pieces]; never falling. Returns
  /// where the shares begin, and the end of the last.
  template <class WorkBefore>
  std::span<const std::size_t> divide(std::size_t threads, std::size_t pieces,
                                      const WorkBefore& work_before) {
    if (parts_.size() != threads) parts_.assign(threads, 1.0 / static_cast<double>(threads)), bounds_.clear();
    const bool known = bounds_.size() == threads + 1 && bounds_.back() == pieces;
    bounds_.resize(threads + 1, 0);
    const auto work = [&](std::size_t piece) { return static_cast<double>(work_before(piece)); };
    double wanted = 0.0;
    for (std::size_t n = 1; n < threads; ++n) {
      wanted += parts_[n - 1] * work(pieces);
      if (known && bounds_[n - 1] <= bounds_[n] && is_near(work, pieces, bounds_[n], wanted)) continue;
      // A piece belongs to the share that its larger part would be in.
      std::size_t end = bounds_[n - 1];
      while (end < pieces && work(end) + work(end + 1) < 2.0 * wanted) ++end;
      bounds_[n] = end;
    }
    bounds_[threads] = pieces;
    work_.resize(threads);
    for (std::size_t n = 0; n < threads; ++n) work_[n] = work(bounds_[n + 1]) - work(bounds_[n]);
    return bounds_;
  }

  /// Of the last division.
  std::span<const std::size_t> bounds() const { return bounds_; }

  /// Takes into account how long the threads took for the shares of the last division, s.
  void learn(std::span<const double> seconds);

 private:
  /// Whether a bound is within three quarters of a piece of where it should be: a share that changes costs
  /// more, for the data that must come from another cache, than such a difference.
  template <class Work>
  static bool is_near(const Work& work, std::size_t pieces, std::size_t bound, double wanted) {
    const double before = work(bound) - (bound == 0 ? 0.0 : work(bound - 1)),
                 after = (bound == pieces ? work(pieces) : work(bound + 1)) - work(bound);
    const double beyond = wanted - work(bound);
    return beyond < 0.0 ? -beyond < 0.75 * before : beyond < 0.75 * after;
  }

  std::vector<double> parts_;        // of all work that each thread should have
  std::vector<double> work_;         // that each one has
  std::vector<std::size_t> bounds_;  // thread n has the pieces [bounds_[n], bounds_[n + 1])
};

}  // namespace vitrum::parallel
