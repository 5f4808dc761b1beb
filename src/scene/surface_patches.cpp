#include "scene/surface_patches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

namespace vitrum {
namespace {

/// A piece of an edge: middle, outward normal's angle, length.
struct Piece {
  Vector2 middle;
  double angle, length;
};
using Pieces = std::vector<Piece>;

int pieces_in(double length, double spacing) {
  return std::max(1, static_cast<int>(std::lround(length / spacing)));
}

/// A straight edge; the body lies to its left.
void cut(const Vector2& from, const Vector2& to, double spacing, Pieces& pieces) {
  const Vector2 way{to[0] - from[0], to[1] - from[1]};
  const double length = std::hypot(way[0], way[1]);
  if (length == 0.0) return;
  const int count = pieces_in(length, spacing);
  for (int k = 0; k < count; ++k) {
    const double s = (k + 0.5) / count;
    pieces.push_back(
        {{from[0] + s * way[0], from[1] + s * way[1]}, std::atan2(-way[0], way[1]), length / count});
  }
}

/// A circle, or its half beyond the axis that it is centred on. outward: the body lies inside it.
void cut(const Disk& circle, bool half, bool outward, double spacing, Pieces& pieces) {
  const double all = half ? std::numbers::pi : 2.0 * std::numbers::pi, first = half ? -0.5 * all : 0.0;
  const int count = pieces_in(all * circle.radius, spacing);
  for (int k = 0; k < count; ++k) {
    const double angle = first + (k + 0.5) / count * all;
    pieces.push_back({{circle.centre[0] + circle.radius * std::cos(angle),
                       circle.centre[1] + circle.radius * std::sin(angle)},
                      outward ? angle : angle + std::numbers::pi,
                      all * circle.radius / count});
  }
}

Pieces edge_of(const Polygon& polygon, bool, double spacing) {
  double area = 0.0;
  const auto& v = polygon.vertices;
  for (std::size_t i = 0, j = v.size() - 1; i < v.size(); j = i++)
    area += v[j][0] * v[i][1] - v[i][0] * v[j][1];
  Pieces pieces;
  for (std::size_t i = 0, j = v.size() - 1; i < v.size(); j = i++)
    area > 0.0 ? cut(v[j], v[i], spacing, pieces) : cut(v[i], v[j], spacing, pieces);
  return pieces;
}
Pieces edge_of(const Box& b, bool axisymmetric, double spacing) {
  return edge_of(Polygon{{b.min, {b.max[0], b.min[1]}, b.max, {b.min[0], b.max[1]}}}, axisymmetric, spacing);
}
Pieces edge_of(const Disk& disk, bool axisymmetric, double spacing) {
  Pieces pieces;
  cut(disk, axisymmetric && disk.centre[0] == 0.0, true, spacing, pieces);
  return pieces;
}
Pieces edge_of(const Ring& ring, bool axisymmetric, double spacing) {
  const bool half = axisymmetric && ring.centre[0] == 0.0;
  Pieces pieces;
  cut({ring.centre, ring.outer}, half, true, spacing, pieces);
  if (ring.inner > 0.0) cut({ring.centre, ring.inner}, half, false, spacing, pieces);
  return pieces;
}

/// Finds the particle of a body that is nearest to a point of its surface.
class Nearest {
 public:
  Nearest(const Particles& particles, double spacing) : particles_(particles), spacing_(spacing) {
    for (std::uint32_t i = 0; i < particles.size; ++i) bins_[bin_of(place(i))].push_back(i);
  }

  std::uint32_t to(const Vector2& x) const {
    const auto [i0, j0] = bin_of(x);
    std::uint32_t nearest = 0;
    double least = std::numeric_limits<double>::infinity();
    const auto look_at = [&](std::uint32_t i) {
      const Vector2 p = place(i);
      const double distance = std::hypot(p[0] - x[0], p[1] - x[1]);
      if (distance < least) nearest = i, least = distance;
    };
    for (long i = i0 - 2; i <= i0 + 2; ++i)
      for (long j = j0 - 2; j <= j0 + 2; ++j)
        if (const auto bin = bins_.find({i, j}); bin != bins_.end())
          for (const std::uint32_t p : bin->second) look_at(p);
    if (!(least <= 2.0 * spacing_))
      for (std::uint32_t i = 0; i < particles_.size; ++i) look_at(i);
    return nearest;
  }

 private:
  Vector2 place(std::uint32_t i) const { return {particles_.position[0][i], particles_.position[1][i]}; }
  std::pair<long, long> bin_of(const Vector2& x) const {
    return {static_cast<long>(std::floor(x[0] / spacing_)), static_cast<long>(std::floor(x[1] / spacing_))};
  }

  const Particles& particles_;
  double spacing_;
  std::map<std::pair<long, long>, std::vector<std::uint32_t>> bins_;
};

}  // namespace

std::vector<mpm::Patch> surface_patches(const Shape& shape, Geometry geometry, const Body& body) {
  const bool axisymmetric = geometry == Geometry::axisymmetric;
  const double spacing = 2.0 * body.particle_half_size;
  const Pieces pieces = std::visit([&](const auto& s) { return edge_of(s, axisymmetric, spacing); }, shape);
  const Nearest nearest(body.particles, spacing);
  std::vector<mpm::Patch> patches;
  for (const Piece& piece : pieces) {
    if (axisymmetric && !(piece.middle[0] > 1e-9 * spacing)) continue;
    const std::uint32_t carrier = nearest.to(piece.middle);
    const auto& x = body.particles.position;
    patches.push_back({body.particles.identity[carrier],
                       {piece.middle[0] - x[0][carrier], piece.middle[1] - x[1][carrier]},
                       piece.angle,
                       piece.length,
                       axisymmetric ? piece.middle[0] : 1.0});
  }
  return patches;
}

}  // namespace vitrum
