#include "scene/shapes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

namespace vitrum {
namespace {

Box bounds_of(const Box& b) {
  return b;
}
Box bounds_of(const Disk& d) {
  return {{d.centre[0] - d.radius, d.centre[1] - d.radius}, {d.centre[0] + d.radius, d.centre[1] + d.radius}};
}
Box bounds_of(const Ring& r) {
  return bounds_of(Disk{r.centre, r.outer});
}
Box bounds_of(const Polygon& p) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Box b{{infinite, infinite}, {-infinite, -infinite}};
  for (const Vector2& v : p.vertices)
    for (std::size_t k = 0; k < 2; ++k)
      b.min[k] = std::min(b.min[k], v[k]), b.max[k] = std::max(b.max[k], v[k]);
  return b;
}

Box bounds_of(const Image& image) {
  constexpr auto most = std::numeric_limits<std::int64_t>::max();
  std::array<std::int64_t, 2> first{most, most}, end{0, 0};
  for (std::int64_t j = 0; j < image.rows(); ++j)
    for (std::int64_t i = 0; i < image.columns(); ++i)
      if (image.holds(i, j))
        first = {std::min(first[0], i), std::min(first[1], j)},
        end = {std::max(end[0], i + 1), std::max(end[1], j + 1)};
  Box b{image.corner, image.corner};
  for (std::size_t k = 0; k < 2 && end[0] > 0; ++k) {
    b.min[k] += static_cast<double>(first[k]) * image.pixel();
    b.max[k] += static_cast<double>(end[k]) * image.pixel();
  }
  return b;
}
Box bounds_of(const Union& together) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  Box b{{infinite, infinite}, {-infinite, -infinite}};
  for (const Region& part : together.parts) {
    const Box of_part = bounds(part);
    for (std::size_t k = 0; k < 2; ++k)
      b.min[k] = std::min(b.min[k], of_part.min[k]), b.max[k] = std::max(b.max[k], of_part.max[k]);
  }
  return b;
}

double squared_distance(const Vector2& a, const Vector2& b) {
  return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
}

bool inside(const Box& b, const Vector2& x) {
  return x[0] > b.min[0] && x[0] < b.max[0] && x[1] > b.min[1] && x[1] < b.max[1];
}
bool inside(const Disk& d, const Vector2& x) {
  return squared_distance(x, d.centre) < d.radius * d.radius;
}
bool inside(const Ring& r, const Vector2& x) {
  const double s = squared_distance(x, r.centre);
  return s < r.outer * r.outer && s >= r.inner * r.inner;
}
/// Even-odd rule.
bool inside(const Polygon& p, const Vector2& x) {
  bool in = false;
  for (std::size_t i = 0, j = p.vertices.size() - 1; i < p.vertices.size(); j = i++) {
    const Vector2 &a = p.vertices[i], &b = p.vertices[j];
    if ((a[1] > x[1]) != (b[1] > x[1]) && x[0] < (b[0] - a[0]) * (x[1] - a[1]) / (b[1] - a[1]) + a[0])
      in = !in;
  }
  return in;
}

bool inside(const Image& image, const Vector2& x) {
  const auto index = [&](std::size_t k) {
    return static_cast<std::int64_t>(std::floor((x[k] - image.corner[k]) / image.pixel()));
  };
  return image.holds(index(0), index(1));
}
bool inside(const Union& together, const Vector2& x) {
  return std::ranges::any_of(together.parts, [&](const Region& part) { return contains(part, x); });
}

/// Whether the corners of the square of side 2 `tolerance` about x lie inside as well.
bool well_inside(const Region& shape, const Vector2& x, double tolerance) {
  for (const double i : {-tolerance, tolerance})
    for (const double j : {-tolerance, tolerance})
      if (!contains(shape, {x[0] + i, x[1] + j})) return false;
  return true;
}

}  // namespace

bool is_composed(const Region& region) {
  return !region.holes.empty() || std::holds_alternative<Union>(region.shape);
}

Box bounds(const Region& region) {
  return std::visit([](const auto& s) { return bounds_of(s); }, region.shape);
}

bool contains(const Region& region, const Vector2& point) {
  return std::visit([&](const auto& s) { return inside(s, point); }, region.shape) &&
         std::ranges::none_of(region.holes, [&](const Region& hole) { return contains(hole, point); });
}

std::optional<Vector2> common_point(const Region& a, const Region& b, double resolution, double tolerance) {
  const Box of_a = bounds(a), of_b = bounds(b);
  constexpr double most_points = 1000.0;  // along each side
  Vector2 first, step;
  std::array<int, 2> count{};
  for (std::size_t k = 0; k < 2; ++k) {
    // Twice the tolerance: the corners of a box that both share must count as well inside.
    first[k] = std::max(of_a.min[k], of_b.min[k]) + 2.0 * tolerance;
    const double side = std::min(of_a.max[k], of_b.max[k]) - 2.0 * tolerance - first[k];
    if (!(side >= 0.0)) return std::nullopt;
    const double steps = std::clamp(std::ceil(side / resolution), 1.0, most_points);
    step[k] = side / steps;
    count[k] = static_cast<int>(steps) + 1;
  }
  for (int j = 0; j < count[1]; ++j)
    for (int i = 0; i < count[0]; ++i) {
      const Vector2 x{first[0] + i * step[0], first[1] + j * step[1]};
      if (well_inside(a, x, tolerance) && well_inside(b, x, tolerance)) return x;
    }
  return std::nullopt;
}

}  // namespace vitrum
