#pragma once
#include <algorithm>

namespace vitrum {

/// The numbers from `low` to `high`. A formula of intervals gives one that holds what the formula gives of
/// numbers out of them (natural interval extension, R. E. Moore, Interval Analysis, 1966; rounding apart),
/// and is wider than that by no more than a constant times their widths.
struct Interval {
  double low, high;

  constexpr Interval(double from, double to) : low(from), high(to) {}
  constexpr Interval(double value) : low(value), high(value) {}  // NOLINT: a number is an interval

  friend constexpr Interval operator-(const Interval& a) { return {-a.high, -a.low}; }
  friend constexpr Interval operator+(const Interval& a, const Interval& b) {
    return {a.low + b.low, a.high + b.high};
  }
  friend constexpr Interval operator-(const Interval& a, const Interval& b) {
    return {a.low - b.high, a.high - b.low};
  }
  friend constexpr Interval operator*(const Interval& a, const Interval& b) {
    const double p = a.low * b.low, q = a.low * b.high, r = a.high * b.low, s = a.high * b.high;
    return {std::min(std::min(p, q), std::min(r, s)), std::max(std::max(p, q), std::max(r, s))};
  }
  /// b: without zero.
  friend constexpr Interval operator/(const Interval& a, const Interval& b) {
    return a * Interval(1.0 / b.high, 1.0 / b.low);
  }
};

}  // namespace vitrum
