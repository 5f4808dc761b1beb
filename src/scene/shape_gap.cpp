#include "scene/shape_gap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scene/surface_edges.hpp"

namespace vitrum {
namespace {

/// Between two boxes: no more than between what they hold.
double gap(const Box& a, const Box& b) {
  const auto along = [&](std::size_t c) { return std::max({a.min[c] - b.max[c], b.min[c] - a.max[c], 0.0}); };
  return std::hypot(along(0), along(1));
}

/// From the points of an edge that may be nearest to another: its ends, and in view of an arc where it is
/// nearest to the centre or, itself an arc, farthest.
double nearest_points(const Edge& from, const Edge& to) {
  double least = std::min(distance(to, from.place(0.0)), distance(to, from.place(1.0)));
  if (!to.is_arc()) return least;
  const Vector2& centre = to.circle().centre;
  least = std::min(least, distance(to, from.place(from.nearest(centre))));
  if (from.is_arc()) {
    const Vector2& own = from.circle().centre;
    least = std::min(
        least, distance(to, from.place(from.nearest({2.0 * own[0] - centre[0], 2.0 * own[1] - centre[1]}))));
  }
  return least;
}

double gap(const Edge& a, const Edge& b) {
  if (!crossings(a, b).empty()) return 0.0;
  return std::min(nearest_points(a, b), nearest_points(b, a));
}

}  // namespace

double gap(const Region& a, const Region& b) {
  const std::vector<Edge> of_a = edges_of(a, false), of_b = edges_of(b, false);
  std::vector<Box> around;
  for (const Edge& edge : of_b) around.push_back(edge.bounds());
  double least = std::numeric_limits<double>::infinity();
  for (const Edge& one : of_a) {
    const Box box = one.bounds();
    for (std::size_t n = 0; n < of_b.size() && least > 0.0; ++n)
      if (gap(box, around[n]) < least) least = std::min(least, gap(one, of_b[n]));
  }
  return least;
}

}  // namespace vitrum
