#include "scene/outline.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include "scene/input_error.hpp"
#include "scene/joined_edges.hpp"
#include "scene/shapes.hpp"

namespace vitrum {
namespace {

Vector2 start_of(const Edge& edge) {
  return edge.place(edge.outward() ? 0.0 : 1.0);
}
Vector2 end_of(const Edge& edge) {
  return edge.place(edge.outward() ? 1.0 : 0.0);
}

/// Twice the area to the left of an edge and of the lines from its ends to the origin.
double swept(const Edge& edge) {
  const Vector2 a = start_of(edge), b = end_of(edge);
  double area = a[0] * b[1] - b[0] * a[1];
  if (edge.is_arc())
    area += (edge.outward() ? 1.0 : -1.0) * edge.circle().radius * edge.circle().radius *
            (edge.angle() - std::sin(edge.angle()));
  return area;
}

/// Follows the edges round, and marks those of holes.
void mark_holes(Edges& edges) {
  std::multimap<Vector2, std::size_t> begins;
  for (std::size_t n = 0; n < edges.size(); ++n) begins.emplace(start_of(edges[n]), n);
  while (!begins.empty()) {
    std::vector<std::size_t> round;
    double area = 0.0;
    for (auto next = begins.begin(); next != begins.end(); next = begins.find(end_of(edges[round.back()]))) {
      round.push_back(next->second);
      area += swept(edges[round.back()]);
      begins.erase(next);
    }
    if (end_of(edges[round.back()]) != start_of(edges[round.front()]))
      throw InputError(
          "found shapes that touch within rounding, expected them to cross, to touch along a common edge, or "
          "to be apart");
    for (const std::size_t n : round) edges[n].set_inner(area < 0.0);
  }
}

double extent(const Region& region) {
  const Box box = bounds(region);
  return std::max({box.max[0] - box.min[0], box.max[1] - box.min[1]});
}

/// The edges of shapes that are put together or cut out one after the other. Each meets those edges alone
/// that its box is near to: all others stay as they are.
class Outline {
 public:
  explicit Outline(double tolerance) : tolerance_(tolerance) {}

  void add(const Region& shape) { place(shape, false); }
  void cut(const Region& shape) { place(shape, true); }

  /// In the order of their shapes.
  Edges edges() const {
    Edges all;
    for (const Placed& each : placed_) all.insert(all.end(), each.left.begin(), each.left.end());
    return all;
  }

 private:
  /// A shape, and what is left of its edges.
  struct Placed {
    const Region* shape;
    Box box;
    bool hole;
    Edges left;
  };

  void place(const Region& shape, bool hole) {
    const Box box = bounds(shape);
    const double reach = 4.0 * tolerance_;
    const auto meets = [&](const Edge& edge) { return near(edge.bounds(), box, reach); };
    std::vector<Placed*> beside;
    for (Placed& each : placed_)
      if (near(each.box, box, reach)) beside.push_back(&each);
    Edges met;
    for (const Placed* each : beside) std::ranges::copy_if(each->left, std::back_inserter(met), meets);

    const auto in_earlier = [&](const Vector2& x) {
      const auto in = [&x](const Placed* each) { return contains(*each->shape, x); };
      return std::ranges::any_of(beside, [&](const Placed* each) { return !each->hole && in(each); }) &&
             std::ranges::none_of(beside, [&](const Placed* each) { return each->hole && in(each); });
    };
    const auto in_shape = [&](const Vector2& x) { return contains(shape, x); };
    const auto join = hole ? without : together;
    Joined joined = join(met, in_earlier, edges_of(shape, false), in_shape, tolerance_);

    auto pieces = joined.a.cbegin();
    for (Placed* each : beside) {
      Edges left;
      for (const Edge& edge : each->left)
        if (meets(edge))
          left.insert(left.end(), pieces->begin(), pieces->end()), ++pieces;
        else
          left.push_back(edge);
      each->left = std::move(left);
    }
    placed_.push_back({&shape, box, hole, std::move(joined.b)});
  }

  double tolerance_;
  std::vector<Placed> placed_;
};

}  // namespace

std::vector<Edge> outline(const Region& region) {
  constexpr double relative_tolerance = 1e-12;
  Outline outline(relative_tolerance * extent(region));
  const Region whole(region.shape);
  if (const auto* parts = std::get_if<Union>(&region.shape))
    for (const Region& part : parts->parts) outline.add(part);
  else
    outline.add(whole);
  for (const Region& hole : region.holes) outline.cut(hole);
  Edges edges = outline.edges();
  mark_holes(edges);
  return edges;
}

std::vector<Edge> outline(const Image& image) {
  const std::int64_t columns = image.columns(), rows = image.rows();
  const auto at = [&](std::int64_t i, std::int64_t j) {
    return Vector2{image.corner[0] + static_cast<double>(i) * image.pixel(),
                   image.corner[1] + static_cast<double>(j) * image.pixel()};
  };
  Edges edges;
  // Along lines between rows (0), then columns (1): which side of a line the body is on, if on one alone.
  for (const std::size_t along : {std::size_t{0}, std::size_t{1}}) {
    const std::int64_t lines = along == 0 ? rows : columns, length = along == 0 ? columns : rows;
    for (std::int64_t line = 0; line <= lines; ++line) {
      int before = 0;
      std::int64_t from = 0;
      for (std::int64_t k = 0; k <= length; ++k) {
        const auto holds = [&](std::int64_t beside) {
          return k < length && (along == 0 ? image.holds(k, beside) : image.holds(beside, k));
        };
        const int side = (holds(line) ? 1 : 0) - (holds(line - 1) ? 1 : 0);
        if (side == before) continue;
        if (before != 0) {
          const Vector2 a = along == 0 ? at(from, line) : at(line, from),
                        b = along == 0 ? at(k, line) : at(line, k);
          edges.push_back((before > 0) == (along == 0) ? Edge::line(a, b) : Edge::line(b, a));
        }
        before = side, from = k;
      }
    }
  }
  mark_holes(edges);
  return edges;
}

}  // namespace vitrum
