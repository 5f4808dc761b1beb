#pragma once
#include <cmath>

namespace vitrum {

/// Least argument found in (low, high] at which `reached` holds, by bisection to the last bit of the
/// interval; `reached(high)` must hold. Works across jumps, and ends on the side where it holds.
template <class Predicate>
double first_reached(double low, double high, Predicate&& reached) {
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (reached(middle) ? high : low) = middle;
  }
  return high;
}

/// Root, to rounding, of a continuous function that is negative at `low` and not negative at `high` (Ridders'
/// method: it keeps the root between two points, and doubles the digits with two values).
template <class Function>
double rising_root(double low, double high, Function&& function) {
  double at_low = function(low), at_high = function(high), last = high;
  const auto narrow = [&](double x, double value) {
    (value < 0.0 ? low : high) = x, (value < 0.0 ? at_low : at_high) = value;
  };
  for (int i = 0; i < 100 && at_low < 0.0 && at_high > 0.0; ++i) {
    const double half = 0.5 * (high - low), middle = low + half, at_middle = function(middle);
    if (middle <= low || middle >= high) break;
    const double x = middle - half * at_middle / std::sqrt(at_middle * at_middle - at_low * at_high);
    narrow(middle, at_middle);
    if (x > low && x < high) narrow(x, function(x));
    if (std::abs(x - last) <= 1e-15 * std::abs(x)) return x;
    last = x;
  }
  return std::abs(at_low) < std::abs(at_high) ? low : high;
}

/// Argument of the least value of `function` in [low, high], where it falls and then rises, by golden
/// section.
template <class Function>
double least_argument(double low, double high, Function&& function) {
  constexpr double golden = 0.61803398874989485;
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double at_a = function(a), at_b = function(b);
  for (int i = 0; i < 50; ++i) {
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a;
      a = high - golden * (high - low), at_a = function(a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + golden * (high - low), at_b = function(b);
    }
  }
  return at_a < at_b ? a : b;
}

}  // namespace vitrum
