#pragma once
#include <array>
#include <cmath>
#include <vector>

#include "scene/seeding.hpp"
#include "scene/shapes.hpp"
#include "scene/surface_edges.hpp"

namespace vitrum::test {

/// A region with holes cut out.
inline Region without(Region shape, const std::vector<Region>& holes) {
  shape.holes = holes;
  return shape;
}

/// Area and moment by rows of points.
inline std::array<double, 2> by_points(const Region& region) {
  constexpr int count = 700;
  const Box box = bounds(region);
  const double dx = (box.max[0] - box.min[0]) / count, dy = (box.max[1] - box.min[1]) / count;
  std::array<double, 2> sum{};
  for (int j = 0; j < count; ++j)
    for (int i = 0; i < count; ++i) {
      const Vector2 x{box.min[0] + (i + 0.5) * dx, box.min[1] + (j + 0.5) * dy};
      if (contains(region, x)) sum[0] += dx * dy, sum[1] += x[0] * dx * dy;
    }
  return sum;
}

/// Area and moment of particles.
inline std::array<double, 2> sums(const std::vector<Seed>& seeds) {
  std::array<double, 2> sum{};
  for (const Seed& seed : seeds) sum[0] += seed.area, sum[1] += seed.area * seed.position[0];
  return sum;
}

/// Integrals of the outward normal over the edges: none over what is closed.
inline std::array<double, 2> open_ends(const std::vector<Edge>& edges) {
  std::array<double, 2> sum{};
  for (const Edge& edge : edges)
    for (int k = 0; k < 200; ++k) {
      const double angle = edge.normal((k + 0.5) / 200), part = edge.length() / 200;
      sum[0] += part * std::cos(angle), sum[1] += part * std::sin(angle);
    }
  return sum;
}

}  // namespace vitrum::test
