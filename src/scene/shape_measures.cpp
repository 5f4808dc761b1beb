#include "scene/shape_measures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/shapes.hpp"
#include "scene/surface_edges.hpp"

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

/// By Green's theorem along the edges, from the axis where some of them end on it.
ShapeMeasures composed(const Region& region, bool half_plane) {
  const Box around = bounds(region);
  const double from = half_plane ? 0.0 : around.min[0];
  ShapeMeasures m{0.0, 0.0, 0.0, std::min(around.max[0] - around.min[0], around.max[1] - around.min[1])};
  for (const Edge& edge : edges_of(region, half_plane)) {
    m.perimeter += edge.length();
    if (edge.is_arc()) {
      const double x = edge.circle().centre[0] - from, r = edge.circle().radius;
      // Integrals of x dy and x^2/2 dy from angle 0 on.
      const auto area = [&](double a) {
        return x * r * std::sin(a) + r * r * (0.5 * a + 0.25 * std::sin(2.0 * a));
      };
      const auto moment = [&](double a) {
        const double s = std::sin(a);
        return 0.5 * (x * x * r * s + 2.0 * x * r * r * (0.5 * a + 0.25 * std::sin(2.0 * a)) +
                      r * r * r * (s - s * s * s / 3.0));
      };
      const double sense = edge.outward() ? 1.0 : -1.0, a = edge.first(), b = a + edge.angle();
      m.area += sense * (area(b) - area(a)), m.moment += sense * (moment(b) - moment(a));
    } else {
      const Vector2 a = edge.place(0.0), b = edge.place(1.0);
      const double xa = a[0] - from, xb = b[0] - from, dy = b[1] - a[1];
      m.area += 0.5 * (xa + xb) * dy, m.moment += (xa * xa + xa * xb + xb * xb) * dy / 6.0;
    }
  }
  m.moment += m.area * from;
  return m;
}
ShapeMeasures kept(const Image& image, bool half_plane) {
  return composed(image, half_plane);
}
ShapeMeasures kept(const Union& together, bool half_plane) {
  return composed(together, half_plane);
}

}  // namespace

ShapeMeasures measures(const Region& region, Geometry geometry) {
  const bool half_plane = geometry == Geometry::axisymmetric;
  if (!region.holes.empty()) return composed(region, half_plane);
  return std::visit([&](const auto& s) { return kept(s, half_plane); }, region.shape);
}

}  // namespace vitrum
