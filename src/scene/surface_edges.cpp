#include "scene/surface_edges.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vitrum {

Edge Edge::line(const Vector2& from, const Vector2& to) {
  Edge edge;
  edge.from_ = from, edge.way_ = {to[0] - from[0], to[1] - from[1]};
  edge.length_ = std::hypot(edge.way_[0], edge.way_[1]);
  return edge;
}

Edge Edge::arc(const Disk& circle, double first, double angle, bool outward) {
  Edge edge;
  edge.is_arc_ = true, edge.outward_ = outward;
  edge.circle_ = circle, edge.first_ = first, edge.angle_ = angle;
  edge.length_ = angle * circle.radius;
  return edge;
}

Vector2 Edge::place(double s) const {
  if (!is_arc_) return {from_[0] + s * way_[0], from_[1] + s * way_[1]};
  const double angle = first_ + s * angle_;
  return {circle_.centre[0] + circle_.radius * std::cos(angle),
          circle_.centre[1] + circle_.radius * std::sin(angle)};
}

double Edge::normal(double s) const {
  if (!is_arc_) return std::atan2(-way_[0], way_[1]);
  const double angle = first_ + s * angle_;
  return outward_ ? angle : angle + std::numbers::pi;
}

int Edge::pieces(double spacing) const {
  return std::max(1, static_cast<int>(std::lround(length_ / spacing)));
}

std::vector<double> Edge::crossings(std::size_t component, double value) const {
  if (!std::isfinite(value)) return {};
  if (!is_arc_) {
    if (way_[component] == 0.0) return {};
    return {(value - from_[component]) / way_[component]};
  }
  const double part = (value - circle_.centre[component]) / circle_.radius;
  if (!(std::abs(part) <= 1.0)) return {};
  const double half = std::acos(part), middle = component == 0 ? 0.0 : 0.5 * std::numbers::pi;
  std::vector<double> list;
  for (const double angle : {middle - half, middle + half})
    for (int turn = -2; turn <= 2; ++turn)
      list.push_back((angle + 2.0 * std::numbers::pi * turn - first_) / angle_);
  return list;
}

namespace {

using Edges = std::vector<Edge>;

void add_circle(const Disk& circle, bool half, bool outward, Edges& edges) {
  const double all = half ? std::numbers::pi : 2.0 * std::numbers::pi, first = half ? -0.5 * all : 0.0;
  edges.push_back(Edge::arc(circle, first, all, outward));
}

Edges edges_of(const Polygon& polygon, bool) {
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
Edges edges_of(const Box& b, bool axisymmetric) {
  return edges_of(Polygon{{b.min, {b.max[0], b.min[1]}, b.max, {b.min[0], b.max[1]}}}, axisymmetric);
}
Edges edges_of(const Disk& disk, bool axisymmetric) {
  Edges edges;
  add_circle(disk, axisymmetric && disk.centre[0] == 0.0, true, edges);
  return edges;
}
Edges edges_of(const Ring& ring, bool axisymmetric) {
  const bool half = axisymmetric && ring.centre[0] == 0.0;
  Edges edges;
  add_circle({ring.centre, ring.outer}, half, true, edges);
  if (ring.inner > 0.0) add_circle({ring.centre, ring.inner}, half, false, edges);
  return edges;
}

}  // namespace

std::vector<Edge> edges_of(const Shape& shape, bool axisymmetric) {
  return std::visit([&](const auto& s) { return edges_of(s, axisymmetric); }, shape);
}

}  // namespace vitrum
