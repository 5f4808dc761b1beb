#include "scene/surface_patches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "scene/nearest_particle.hpp"
#include "scene/surface_edges.hpp"

namespace vitrum {
namespace {

/// Where edges meet.
class Corners {
 public:
  Corners(const std::vector<Edge>& edges, double axis) : axis_(axis) {
    for (const Edge& edge : edges)
      for (const double s : {0.0, 1.0}) normals_[edge.place(s)].push_back(edge.normal(s));
  }

  /// By how much the surface turns where an edge ends (s = 0 or 1), rad.
  double turn(const Edge& edge, double s) const {
    const Vector2 end = edge.place(s);
    const double normal = edge.normal(s);
    const auto from = [&](double other) { return std::abs(std::remainder(other - normal, 2.0 * pi)); };
    if (end[0] < axis_) return from(pi - normal);  // its own image
    double largest = 0.0;
    for (const double other : normals_.at(end)) largest = std::max(largest, from(other));
    return largest;
  }

 private:
  static constexpr double pi = std::numbers::pi;
  std::map<Vector2, std::vector<double>> normals_;
  double axis_;  ///< m, radius below which a place is on the axis
};

/// Of the surface about a place of an edge, 1/m: that of a circle that turns as far as the corners do which
/// are near (four spacings, over which a body's corner can be pressed into another one).
double curvature(const Edge& edge, double s, const Corners& corners, double spacing) {
  double largest = edge.is_arc() ? 1.0 / edge.circle().radius : 0.0;
  for (const double end : {0.0, 1.0})
    if (const double way = std::abs(s - end) * edge.length(); way < 4.0 * spacing)
      largest = std::max(largest, corners.turn(edge, end) / way);
  return largest;
}

}  // namespace

std::vector<mpm::Patch> surface_patches(const Region& region, Geometry geometry, const Body& body) {
  const bool axisymmetric = geometry == Geometry::axisymmetric;
  const double spacing = 2.0 * body.particle_half_size;
  const NearestParticle nearest(body.particles, spacing);
  std::vector<mpm::Patch> patches;
  const std::vector<Edge> edges = edges_of(region, axisymmetric);
  const double axis = axisymmetric ? 1e-9 * spacing : -std::numeric_limits<double>::infinity();
  const Corners corners(edges, axis);
  for (const Edge& edge : edges) {
    const int count = edge.pieces(spacing);
    for (int k = 0; k < count; ++k) {
      const double s = (k + 0.5) / count;
      const Vector2 middle = edge.place(s);
      if (!(middle[0] > axis)) continue;
      const std::uint32_t carrier = nearest.to(middle);
      const auto& x = body.particles.position;
      patches.push_back({body.particles.identity[carrier],
                         {middle[0] - x[0][carrier], middle[1] - x[1][carrier]},
                         edge.normal(s),
                         edge.length() / count,
                         axisymmetric ? middle[0] : 1.0,
                         curvature(edge, s, corners, spacing)});
    }
  }
  return patches;
}

}  // namespace vitrum
