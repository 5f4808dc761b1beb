#include "scene/polygon_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace vitrum::scene {
namespace {

constexpr double relative_tolerance = 1.0e-12;

double distance(const Vector2& a, const Vector2& b) {
  return std::hypot(b[0] - a[0], b[1] - a[1]);
}

/// Twice the signed area of the triangle (a, b, c).
double turn(const Vector2& a, const Vector2& b, const Vector2& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

double distance_to_segment(const Vector2& p, const Vector2& a, const Vector2& b) {
  const double length = distance(a, b);
  const double along = ((p[0] - a[0]) * (b[0] - a[0]) + (p[1] - a[1]) * (b[1] - a[1])) / (length * length);
  const double t = std::clamp(along, 0.0, 1.0);
  return distance(p, {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
}

bool segments_meet(const Vector2& a, const Vector2& b, const Vector2& c, const Vector2& d, double tolerance) {
  const bool crossing =
      (turn(a, b, c) > 0.0) != (turn(a, b, d) > 0.0) && (turn(c, d, a) > 0.0) != (turn(c, d, b) > 0.0);
  return crossing || distance_to_segment(c, a, b) <= tolerance || distance_to_segment(d, a, b) <= tolerance ||
         distance_to_segment(a, c, d) <= tolerance || distance_to_segment(b, c, d) <= tolerance;
}

double extent(std::span<const Vector2> vertices) {
  Vector2 low = vertices.front(), high = vertices.front();
  for (const Vector2& v : vertices) {
    low = {std::min(low[0], v[0]), std::min(low[1], v[1])};
    high = {std::max(high[0], v[0]), std::max(high[1], v[1])};
  }
  return distance(low, high);
}

}  // namespace

std::string polygon_fault(std::span<const Vector2> vertices) {
  const std::size_t n = vertices.size();
  if (n < 3) return fmt::format("{} vertices", n);
  const double size = extent(vertices), tolerance = relative_tolerance * size;
  const auto at = [&](std::size_t i) -> const Vector2& { return vertices[i % n]; };
  double area = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    if (distance(at(i), at(i + 1)) <= tolerance)
      return fmt::format("vertices {} and {} in the same place", i, (i + 1) % n);
    area += 0.5 * turn(at(0), at(i), at(i + 1));
  }
  if (std::abs(area) <= tolerance * size) return "zero area";
  for (std::size_t i = 0; i < n; ++i) {
    // An edge that folds back onto its predecessor has its end, or the predecessor's start, on the other
    // edge.
    const std::size_t next = (i + 1) % n;
    if (distance_to_segment(at(i + 2), at(i), at(i + 1)) <= tolerance ||
        distance_to_segment(at(i), at(i + 1), at(i + 2)) <= tolerance)
      return fmt::format("edges {} and {} that overlap", i, next);
    for (std::size_t j = i + 2; j < n; ++j)
      if (j + 1 - i != n && segments_meet(at(i), at(i + 1), at(j), at(j + 1), tolerance))
        return fmt::format("edges {} and {} that cross or touch", i, j);
  }
  return {};
}

}  // namespace vitrum::scene
