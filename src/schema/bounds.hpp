#pragma once
#include <limits>

namespace vitrum {

/// Interval of admissible values; the ends belong to it unless marked open.
struct Bounds {
  double lowest, highest;
  bool lowest_open = false, highest_open = false;

  constexpr bool contain(double v) const {
    return (lowest_open ? v > lowest : v >= lowest) && (highest_open ? v < highest : v <= highest);
  }
};

namespace intervals {
inline constexpr double infinite = std::numeric_limits<double>::infinity();
inline constexpr Bounds positive{0.0, infinite, true, true};
inline constexpr Bounds not_negative{0.0, infinite, false, true};
inline constexpr Bounds fraction{0.0, 1.0};
inline constexpr Bounds finite{-infinite, infinite, true, true};
inline constexpr Bounds infinite_too{-infinite, infinite};
}  // namespace intervals

}  // namespace vitrum
