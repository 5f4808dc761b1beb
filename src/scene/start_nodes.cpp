#include "scene/start_nodes.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/shape.hpp"

namespace vitrum {
namespace {

template <mpm::ShapeKind kind>
std::vector<NodeIndex> nodes(const System& system, const Body& body, const Box& box) {
  using Shape = mpm::Shape1<kind>;
  constexpr double share = 1e-9;
  const double per_cell = 1.0 / system.cell;
  std::vector<NodeIndex> found;
  const Particles& p = body.particles;
  const double slack = 1e-9 * system.cell, reach = 2.0 * system.cell;
  const auto inside = [&](const Vector2& x, double by) {
    return x[0] >= box.min[0] - by && x[0] <= box.max[0] + by && x[1] >= box.min[1] - by &&
           x[1] <= box.max[1] + by;
  };
  for (std::size_t i = 0; i < p.size; ++i) {
    if (!inside({p.position[0][i], p.position[1][i]}, reach)) continue;
    const auto x = Shape::at(p.position[0][i] * per_cell, body.half(0, i) * per_cell),
               y = Shape::at(p.position[1][i] * per_cell, body.half(1, i) * per_cell);
    for (std::size_t b = 0; b < static_cast<std::size_t>(Shape::count); ++b)
      for (std::size_t a = 0; a < static_cast<std::size_t>(Shape::count); ++a) {
        const NodeIndex node{x.first + static_cast<std::int64_t>(a), y.first + static_cast<std::int64_t>(b)};
        const Vector2 at{static_cast<double>(node[0]) * system.cell,
                         static_cast<double>(node[1]) * system.cell};
        if (x.value[a] * y.value[b] > share && !(system.axisymmetric && node[0] < 0) && inside(at, slack))
          found.push_back(node);
      }
  }
  std::ranges::sort(found);
  found.erase(std::ranges::unique(found).begin(), found.end());
  return found;
}

}  // namespace

std::vector<NodeIndex> nodes_of(const System& system, const Body& body, const Box& box) {
  switch (system.grid.shape()) {
    case mpm::ShapeKind::linear:
      return nodes<mpm::ShapeKind::linear>(system, body, box);
    case mpm::ShapeKind::gimp:
      return nodes<mpm::ShapeKind::gimp>(system, body, box);
    case mpm::ShapeKind::cpgimp:
      return nodes<mpm::ShapeKind::cpgimp>(system, body, box);
    case mpm::ShapeKind::bspline2:
      return nodes<mpm::ShapeKind::bspline2>(system, body, box);
  }
  return {};
}

std::size_t count_common(const std::vector<NodeIndex>& a, const std::vector<NodeIndex>& b) {
  return static_cast<std::size_t>(
      std::ranges::count_if(a, [&](const NodeIndex& node) { return std::ranges::binary_search(b, node); }));
}

}  // namespace vitrum
