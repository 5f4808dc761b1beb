#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

#include "mpm/shape_kind.hpp"

namespace vitrum::mpm {

/// Largest integer not above x, |x| < 2^31. (std::floor is a library call on processors without SSE 4.1, and
/// 64-bit integers are not converted four at a time.)
inline std::int32_t cell_of(double x) {
  const auto truncated = static_cast<std::int32_t>(x);
  return truncated - static_cast<std::int32_t>(x < static_cast<double>(truncated));
}

/// One-dimensional shape function values of one particle: nodes first .. first + count - 1.
template <int count>
struct Weights1 {
  std::int32_t first;
  std::array<double, count> value;  ///< N
  std::array<double, count> slope;  ///< h dN/dx
};

/// The nodes a particle touches and N, h dN/dx there. x: position in cells; half: half the particle's side in
/// cells (GIMP).
template <ShapeKind kind>
struct Shape1;

/// Piecewise linear (the paper's).
template <>
struct Shape1<ShapeKind::linear> {
  static constexpr int count = 2;
  /// A particle exactly on a node is taken to be a rounding inside the cell: with N = 0 but a slope of 1, the
  /// cell's other node may be empty, and its velocity would be read as 0 (N / m has a limit there, 0 / 0 has
  /// none).
  static constexpr double nearest = 1e-15;
  static Weights1<2> at(double x, double /*half*/) {
    const std::int32_t cell = cell_of(x);
    const double s = std::clamp(x - static_cast<double>(cell), nearest, 1.0 - nearest);
    return {cell, {1.0 - s, s}, {-1.0, 1.0}};
  }
};

/// Quadratic B-spline.
template <>
struct Shape1<ShapeKind::bspline2> {
  static constexpr int count = 3;
  static Weights1<3> at(double x, double /*half*/) {
    const std::int32_t first = cell_of(x - 0.5);
    const double s = x - static_cast<double>(first) - 1.0;  // in [-0.5, 0.5) about the middle node
    return {first,
            {0.5 * (0.5 - s) * (0.5 - s), 0.75 - s * s, 0.5 * (0.5 + s) * (0.5 + s)},
            {s - 0.5, -2.0 * s, s + 0.5}};
  }
};

/// The linear function averaged over what a particle extends over, at the nodes from `first` on.
struct AveragedHat {
  template <int count>
  static Weights1<count> at(std::int32_t first, double x, double half) {
    const double width = 0.5 / half;
    Weights1<count> w{first, {}, {}};
    for (int k = 0; k < count; ++k) {
      const double node = static_cast<double>(first + k), low = x - half - node, high = x + half - node;
      w.value[static_cast<std::size_t>(k)] = width * (area(high) - area(low));
      w.slope[static_cast<std::size_t>(k)] = width * (hat(high) - hat(low));
    }
    return w;
  }

 private:
  static double hat(double t) { return t <= -1.0 || t >= 1.0 ? 0.0 : (t < 0.0 ? 1.0 + t : 1.0 - t); }
  /// Integral of the hat from -1 to t.
  static double area(double t) {
    if (t <= -1.0) return 0.0;
    if (t >= 1.0) return 1.0;
    return t < 0.0 ? 0.5 * (1.0 + t) * (1.0 + t) : 0.5 + t - 0.5 * t * t;
  }
};

/// Uniform GIMP: the average over the particle's initial square.
template <>
struct Shape1<ShapeKind::gimp> {
  static constexpr int count = 3;
  static Weights1<3> at(double x, double half) { return AveragedHat::at<3>(cell_of(x - half), x, half); }
};

/// The average over a domain that follows the particle's stretch (mpm/domain.hpp), up to twice the cell.
template <>
struct Shape1<ShapeKind::cpgimp> {
  static constexpr int count = 4;
  static constexpr double largest_half = 1.0;
  /// last: where the nodes may begin at the latest, whose weights are 0 beyond.
  static Weights1<4> at(double x, double half, std::int32_t last = std::numeric_limits<std::int32_t>::max()) {
    return AveragedHat::at<4>(std::min(cell_of(x - half), last), x, half);
  }
};

}  // namespace vitrum::mpm
