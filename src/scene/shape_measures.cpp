#include "scene/shape_measures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/shapes.hpp"

namespace vitrum {
namespace {

using std::numbers::pi;

ShapeMeasures kept(const Box& b, bool) {
  const double x = b.max[0] - b.min[0], y = b.max[1] - b.min[1];
  return {x * y, x * y * 0.5 * (b.min[0] + b.max[0]), 2.0 * (x + y), std::min(x, y)};
}

/// half_plane: what lies at x > 0.
ShapeMeasures kept(const Disk& d, bool half_plane) {
  const double x = d.centre[0], r = d.radius;
  if (!half_plane || x >= r) return {pi * r * r, pi * r * r * x, 2.0 * pi * r, 2.0 * r};
  const double angle = pi - std::acos(x / r), half_chord = std::sqrt((r - x) * (r + x));
  const double area = r * r * angle + x * half_chord;
  return {area, area * x + 2.0 / 3.0 * half_chord * half_chord * half_chord, 2.0 * r * angle,
          std::min(x + r, 2.0 * r)};
}

ShapeMeasures kept(const Ring& ring, bool half_plane) {
  const ShapeMeasures outer = kept(Disk{ring.centre, ring.outer}, half_plane),
                      inner = kept(Disk{ring.centre, ring.inner}, half_plane);
  return {outer.area - inner.area, outer.moment - inner.moment, outer.perimeter + inner.perimeter,
          outer.width};
}

ShapeMeasures kept(const Polygon& p, bool) {
  const Box around = bounds(p);
  ShapeMeasures m{0.0, 0.0, 0.0, std::min(around.max[0] - around.min[0], around.max[1] - around.min[1])};
  // From one of the vertices: far from the origin differences of products would be rounding.
  const Vector2& from = p.vertices.front();
  for (std::size_t i = 0, j = p.vertices.size() - 1; i < p.vertices.size(); j = i++) {
    const Vector2 a{p.vertices[j][0] - from[0], p.vertices[j][1] - from[1]};
    const Vector2 b{p.vertices[i][0] - from[0], p.vertices[i][1] - from[1]};
    const double twice = a[0] * b[1] - b[0] * a[1];
    m.area += 0.5 * twice;
    m.moment += twice * (a[0] + b[0]) / 6.0;
    m.perimeter += std::hypot(b[0] - a[0], b[1] - a[1]);
  }
  if (m.area < 0.0) m.area = -m.area, m.moment = -m.moment;
  m.moment += m.area * from[0];
  return m;
}

}  // namespace

ShapeMeasures measures(const Shape& shape, Geometry geometry) {
  return std::visit([&](const auto& s) { return kept(s, geometry == Geometry::axisymmetric); }, shape);
}

}  // namespace vitrum
