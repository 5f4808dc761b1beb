#include "scene/shape_measures.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/shapes.hpp"

namespace vitrum {
namespace {

using std::numbers::pi;

ShapeMeasures whole(const Box& b) {
  const double x = b.max[0] - b.min[0], y = b.max[1] - b.min[1];
  return {x * y, 2.0 * (x + y), std::min(x, y)};
}
ShapeMeasures whole(const Disk& d) {
  return {pi * d.radius * d.radius, 2.0 * pi * d.radius, 2.0 * d.radius};
}
ShapeMeasures whole(const Ring& r) {
  return {pi * (r.outer * r.outer - r.inner * r.inner), 2.0 * pi * (r.outer + r.inner), 2.0 * r.outer};
}
ShapeMeasures whole(const Polygon& p) {
  ShapeMeasures m{0.0, 0.0, whole(bounds(p)).width};
  for (std::size_t i = 0, j = p.vertices.size() - 1; i < p.vertices.size(); j = i++) {
    const Vector2 &a = p.vertices[j], &b = p.vertices[i];
    m.area += 0.5 * (a[0] * b[1] - b[0] * a[1]);
    m.perimeter += std::hypot(b[0] - a[0], b[1] - a[1]);
  }
  m.area = std::abs(m.area);
  return m;
}

}  // namespace

ShapeMeasures measures(const Shape& shape, Geometry geometry) {
  ShapeMeasures m = std::visit([](const auto& s) { return whole(s); }, shape);
  const Box box = bounds(shape);
  if (geometry == Geometry::axisymmetric && box.min[0] < 0.0) {
    const double kept = box.max[0] / (box.max[0] - box.min[0]);
    m.area *= kept, m.perimeter *= kept, m.width *= kept;
  }
  return m;
}

}  // namespace vitrum
