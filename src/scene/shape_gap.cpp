#include "scene/shape_gap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vitrum {
namespace {

struct Segment {
  Vector2 from, to;
};

/// What a shape's edge consists of.
struct Edge {
  std::vector<Segment> segments;
  std::vector<Disk> circles;
};

Edge closed(const std::vector<Vector2>& vertices) {
  Edge edge;
  for (std::size_t i = 0, j = vertices.size() - 1; i < vertices.size(); j = i++)
    edge.segments.push_back({vertices[j], vertices[i]});
  return edge;
}
Edge edge_of(const Box& b) {
  return closed({b.min, {b.max[0], b.min[1]}, b.max, {b.min[0], b.max[1]}});
}
Edge edge_of(const Disk& d) {
  return {{}, {d}};
}
Edge edge_of(const Ring& r) {
  return {{}, {{r.centre, r.inner}, {r.centre, r.outer}}};
}
Edge edge_of(const Polygon& p) {
  return closed(p.vertices);
}

double distance(const Vector2& a, const Vector2& b) {
  return std::hypot(b[0] - a[0], b[1] - a[1]);
}

double cross(const Vector2& a, const Vector2& b, const Vector2& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

double distance(const Segment& s, const Vector2& x) {
  const Vector2 along{s.to[0] - s.from[0], s.to[1] - s.from[1]};
  const double squared = along[0] * along[0] + along[1] * along[1];
  const double t = ((x[0] - s.from[0]) * along[0] + (x[1] - s.from[1]) * along[1]) / squared;
  const double at = squared > 0.0 ? std::clamp(t, 0.0, 1.0) : 0.0;
  return distance(x, {s.from[0] + at * along[0], s.from[1] + at * along[1]});
}

double distance(const Segment& a, const Segment& b) {
  const auto parts = [](const Segment& s, const Segment& other) {
    return (cross(s.from, s.to, other.from) < 0.0) != (cross(s.from, s.to, other.to) < 0.0);
  };
  if (parts(a, b) && parts(b, a)) return 0.0;
  return std::min({distance(a, b.from), distance(a, b.to), distance(b, a.from), distance(b, a.to)});
}

/// Between a line of points whose distances from a circle's centre run from nearest to farthest, and the
/// circle.
double from_circle(double nearest, double farthest, double radius) {
  return std::max({nearest - radius, radius - farthest, 0.0});
}

double distance(const Segment& s, const Disk& circle) {
  return from_circle(distance(s, circle.centre),
                     std::max(distance(s.from, circle.centre), distance(s.to, circle.centre)), circle.radius);
}

double distance(const Disk& a, const Disk& b) {
  const double between = distance(a.centre, b.centre);
  return from_circle(std::abs(between - a.radius), between + a.radius, b.radius);
}

}  // namespace

double gap(const Shape& a, const Shape& b) {
  const auto edge = [](const Shape& shape) {
    return std::visit([](const auto& s) { return edge_of(s); }, shape);
  };
  const Edge of_a = edge(a), of_b = edge(b);
  double least = std::numeric_limits<double>::infinity();
  const auto compare = [&least](const auto& some, const auto& others) {
    for (const auto& one : some)
      for (const auto& other : others) least = std::min(least, distance(one, other));
  };
  compare(of_a.segments, of_b.segments), compare(of_a.segments, of_b.circles);
  compare(of_b.segments, of_a.circles), compare(of_a.circles, of_b.circles);
  return least;
}

}  // namespace vitrum
