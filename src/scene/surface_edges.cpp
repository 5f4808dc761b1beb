#include "scene/surface_edges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/outline.hpp"
#include "scene/shapes.hpp"

namespace vitrum {

using std::numbers::pi;

namespace {

double length_of(const Vector2& way) {
  return std::hypot(way[0], way[1]);
}
Vector2 between(const Vector2& from, const Vector2& to) {
  return {to[0] - from[0], to[1] - from[1]};
}
Vector2 on_circle(const Disk& circle, double angle) {
  return {circle.centre[0] + circle.radius * std::cos(angle),
          circle.centre[1] + circle.radius * std::sin(angle)};
}

}  // namespace

Edge Edge::line(const Vector2& from, const Vector2& to) {
  Edge edge;
  edge.from_ = from, edge.to_ = to;
  edge.length_ = length_of(between(from, to));
  return edge;
}

Edge Edge::arc(const Disk& circle, double first, double angle, bool outward) {
  Edge edge;
  edge.is_arc_ = true, edge.outward_ = outward, edge.inner_ = !outward;
  edge.circle_ = circle, edge.first_ = first, edge.angle_ = angle;
  edge.length_ = angle * circle.radius;
  edge.from_ = on_circle(circle, first), edge.to_ = on_circle(circle, first + angle);
  return edge;
}

Vector2 Edge::place(double s) const {
  if (s == 0.0) return from_;
  if (s == 1.0) return to_;
  if (!is_arc_) {
    const Vector2 way = between(from_, to_);
    return {from_[0] + s * way[0], from_[1] + s * way[1]};
  }
  return on_circle(circle_, first_ + s * angle_);
}

double Edge::normal(double s) const {
  if (!is_arc_) {
    const Vector2 way = between(from_, to_);
    return std::atan2(-way[0], way[1]);
  }
  const double angle = first_ + s * angle_;
  return outward_ ? angle : angle + pi;
}

int Edge::pieces(double spacing) const {
  return std::max(1, static_cast<int>(std::lround(length_ / spacing)));
}

std::vector<double> Edge::crossings(std::size_t component, double value) const {
  if (!std::isfinite(value)) return {};
  if (!is_arc_) {
    const Vector2 way = between(from_, to_);
    if (way[component] == 0.0) return {};
    return {(value - from_[component]) / way[component]};
  }
  const double part = (value - circle_.centre[component]) / circle_.radius;
  if (!(std::abs(part) <= 1.0)) return {};
  const double half = std::acos(part), middle = component == 0 ? 0.0 : 0.5 * pi;
  std::vector<double> list;
  for (const double at : {middle - half, middle + half})
    for (int turn = -2; turn <= 2; ++turn) list.push_back((at + 2.0 * pi * turn - first_) / angle_);
  return list;
}

std::vector<double> Edge::corners() const {
  std::vector<double> list;
  for (int quarter = -9; is_arc_ && quarter <= 9; ++quarter)
    list.push_back(((0.25 + 0.5 * quarter) * pi - first_) / angle_);
  return list;
}

double Edge::nearest(const Vector2& x) const {
  if (!is_arc_) {
    const Vector2 way = between(from_, to_), there = between(from_, x);
    const double squared = way[0] * way[0] + way[1] * way[1];
    return squared > 0.0 ? std::clamp((there[0] * way[0] + there[1] * way[1]) / squared, 0.0, 1.0) : 0.0;
  }
  const double at = std::atan2(x[1] - circle_.centre[1], x[0] - circle_.centre[0]) - first_,
               turned = at - 2.0 * pi * std::floor(at / (2.0 * pi));
  if (turned <= angle_) return turned / angle_;
  return length_of(between(from_, x)) <= length_of(between(to_, x)) ? 0.0 : 1.0;
}

Edge Edge::piece(double from, double to, const Vector2& start, const Vector2& end) const {
  Edge edge = *this;
  edge.from_ = start, edge.to_ = end;
  if (is_arc_) edge.first_ = first_ + from * angle_, edge.angle_ = (to - from) * angle_;
  edge.length_ = is_arc_ ? edge.angle_ * circle_.radius : length_of(between(start, end));
  return edge;
}

Edge Edge::reversed() const {
  Edge edge = *this;
  if (is_arc_)
    edge.outward_ = !outward_;
  else
    std::swap(edge.from_, edge.to_);
  return edge;
}

Box Edge::bounds() const {
  Box box{{std::min(from_[0], to_[0]), std::min(from_[1], to_[1])},
          {std::max(from_[0], to_[0]), std::max(from_[1], to_[1])}};
  // An arc may turn back within.
  for (int quarter = -4; is_arc_ && quarter <= 8; ++quarter)
    if (const double s = (0.5 * quarter * pi - first_) / angle_; s > 0.0 && s < 1.0) {
      const Vector2 x = place(s);
      for (std::size_t c = 0; c < 2; ++c)
        box.min[c] = std::min(box.min[c], x[c]), box.max[c] = std::max(box.max[c], x[c]);
    }
  return box;
}

double distance(const Edge& edge, const Vector2& x) {
  return length_of(between(edge.place(edge.nearest(x)), x));
}

namespace {

double cross(const Vector2& a, const Vector2& b) {
  return a[0] * b[1] - a[1] * b[0];
}

std::vector<Vector2> crossings_of_lines(const Edge& a, const Edge& b) {
  const Vector2 from = a.place(0.0), way = between(from, a.place(1.0)), other = b.place(0.0),
                other_way = between(other, b.place(1.0));
  const double both = cross(way, other_way);
  if (both == 0.0) return {};
  const Vector2 apart = between(from, other);
  const double s = cross(apart, other_way) / both, t = cross(apart, way) / both;
  if (!(s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0)) return {};
  return {a.place(s)};
}

/// Whether the direction of a point from the circle's centre is one of an arc's.
bool spans(const Edge& arc, const Vector2& x) {
  const double at = std::atan2(x[1] - arc.circle().centre[1], x[0] - arc.circle().centre[0]) - arc.first();
  return at - 2.0 * pi * std::floor(at / (2.0 * pi)) <= arc.angle();
}

std::vector<Vector2> crossings_of_line_and_arc(const Edge& line, const Edge& arc) {
  const Vector2 from = line.place(0.0), way = between(from, line.place(1.0)),
                apart = between(arc.circle().centre, from);
  const double a = way[0] * way[0] + way[1] * way[1], half_b = apart[0] * way[0] + apart[1] * way[1],
               across = cross(apart, way), r = arc.circle().radius, squared = a * r * r - across * across;
  std::vector<Vector2> list;
  if (!(squared > 0.0)) return list;
  for (const double sign : {-1.0, 1.0}) {
    const double s = (-half_b + sign * std::sqrt(squared)) / a;
    if (!(s >= 0.0 && s <= 1.0)) continue;
    if (const Vector2 x = line.place(s); spans(arc, x)) list.push_back(x);
  }
  return list;
}

std::vector<Vector2> crossings_of_arcs(const Edge& a, const Edge& b) {
  const Vector2 apart = between(a.circle().centre, b.circle().centre);
  const double d = length_of(apart), ra = a.circle().radius, rb = b.circle().radius;
  std::vector<Vector2> list;
  if (!(d > 0.0)) return list;
  const double along = 0.5 * (d + (ra - rb) * (ra + rb) / d), squared = (ra - along) * (ra + along);
  if (!(squared > 0.0)) return list;
  for (const double sign : {-1.0, 1.0}) {
    const double across = sign * std::sqrt(squared);
    const Vector2 x{a.circle().centre[0] + (along * apart[0] - across * apart[1]) / d,
                    a.circle().centre[1] + (along * apart[1] + across * apart[0]) / d};
    if (spans(a, x) && spans(b, x)) list.push_back(x);
  }
  return list;
}

}  // namespace

std::vector<Vector2> crossings(const Edge& a, const Edge& b) {
  if (a.is_arc() && b.is_arc()) return crossings_of_arcs(a, b);
  if (a.is_arc()) return crossings_of_line_and_arc(b, a);
  return b.is_arc() ? crossings_of_line_and_arc(a, b) : crossings_of_lines(a, b);
}

namespace {

using Edges = std::vector<Edge>;

void add_circle(const Disk& circle, bool half, bool outward, Edges& edges) {
  const double all = half ? pi : 2.0 * pi, first = half ? -0.5 * all : 0.0;
  edges.push_back(Edge::arc(circle, first, all, outward));
}

Edges simple_edges(const Polygon& polygon, bool) {
  double area = 0.0;
  const auto& v = polygon.vertices;
  for (std::size_t i = 0, j = v.size() - 1; i < v.size(); j = i++)
    area += v[j][0] * v[i][1] - v[i][0] * v[j][1];
  Edges edges;
  for (std::size_t i = 0, j = v.size() - 1; i < v.size(); j = i++)
    edges.push_back(area > 0.0 ? Edge::line(v[j], v[i]) : Edge::line(v[i], v[j]));
  std::erase_if(edges, [](const Edge& edge) { return edge.length() == 0.0; });
  return edges;
}
Edges simple_edges(const Box& b, bool axisymmetric) {
  return simple_edges(Polygon{{b.min, {b.max[0], b.min[1]}, b.max, {b.min[0], b.max[1]}}}, axisymmetric);
}
Edges simple_edges(const Disk& disk, bool axisymmetric) {
  Edges edges;
  add_circle(disk, axisymmetric && disk.centre[0] == 0.0, true, edges);
  return edges;
}
Edges simple_edges(const Ring& ring, bool axisymmetric) {
  const bool half = axisymmetric && ring.centre[0] == 0.0;
  Edges edges;
  add_circle({ring.centre, ring.outer}, half, true, edges);
  if (ring.inner > 0.0) add_circle({ring.centre, ring.inner}, half, false, edges);
  return edges;
}
Edges simple_edges(const Image& image, bool) {
  return outline(image);
}
Edges simple_edges(const Union& parts, bool) {
  return outline(Region(parts));
}

/// What of the edges lies at r > 0.
Edges beyond_axis(const Edges& edges) {
  Edges kept;
  for (const Edge& edge : edges) {
    std::vector<double> cuts{0.0, 1.0};
    for (const double s : edge.crossings(0, 0.0))
      if (s > 0.0 && s < 1.0) cuts.push_back(s);
    std::ranges::sort(cuts);
    for (std::size_t n = 0; n + 1 < cuts.size(); ++n)
      if (edge.place(0.5 * (cuts[n] + cuts[n + 1]))[0] > 0.0)
        kept.push_back(edge.piece(cuts[n], cuts[n + 1], edge.place(cuts[n]), edge.place(cuts[n + 1])));
  }
  return kept;
}

}  // namespace

std::vector<Edge> edges_of(const Region& region, bool axisymmetric) {
  const Edges edges =
      region.holes.empty()
          ? std::visit([&](const auto& s) { return simple_edges(s, axisymmetric); }, region.shape)
          : outline(region);
  return axisymmetric && is_composed(region) ? beyond_axis(edges) : edges;
}

}  // namespace vitrum
