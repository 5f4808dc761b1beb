#pragma once
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

namespace vitrum::test {

/// Order of convergence from errors at two resolutions whose ratio is `refinement`.
inline double order(double coarse_error, double fine_error, double refinement = 2.0) {
  return std::log(coarse_error / fine_error) / std::log(refinement);
}

/// A root of f between a and b, where it has opposite signs.
inline double root(const std::function<double(double)>& f, double a, double b) {
  const bool rising = f(b) > 0.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (a + b);
    ((f(middle) > 0.0) == rising ? b : a) = middle;
  }
  return 0.5 * (a + b);
}

/// Samples of an oscillation about zero.
class Oscillation {
 public:
  void add(double time, double value) {
    if (!samples_.empty() && samples_.back().second * value < 0.0) {
      const auto [t, v] = samples_.back();
      zeros_.push_back(t + (time - t) * v / (v - value));
    }
    samples_.emplace_back(time, value);
  }
  std::size_t zeros() const { return zeros_.size(); }
  /// Angular frequency from the first zero to the last (linear between samples); at least two zeros are
  /// needed.
  double frequency() const {
    return 3.14159265358979323846 * static_cast<double>(zeros_.size() - 1) / (zeros_.back() - zeros_.front());
  }

 private:
  std::vector<std::pair<double, double>> samples_;
  std::vector<double> zeros_;
};

}  // namespace vitrum::test
