#include "scene/outline.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>

#include "scene/input_error.hpp"
#include "scene/shapes.hpp"

namespace vitrum {
namespace {

using Edges = std::vector<Edge>;
using Inside = std::function<bool(const Vector2&)>;

double apart(const Vector2& a, const Vector2& b) {
  return std::hypot(b[0] - a[0], b[1] - a[1]);
}
bool near(const Box& a, const Box& b, double reach) {
  bool result = true;
  for (std::size_t c = 0; c < 2; ++c)
    result = result && a.min[c] <= b.max[c] + reach && b.min[c] <= a.max[c] + reach;
  return result;
}

/// Points of which those that are within a tolerance are one.
class Vertices {
 public:
  explicit Vertices(double tolerance) : tolerance_(tolerance) {}
  /// The point that stands for one.
  Vector2 of(const Vector2& x) {
    const Bin home = bin(x);
    for (long i = -1; i <= 1; ++i)
      for (long j = -1; j <= 1; ++j)
        if (const auto found = bins_.find({home[0] + i, home[1] + j}); found != bins_.end())
          for (const Vector2& y : found->second)
            if (apart(x, y) <= tolerance_) return y;
    bins_[home].push_back(x);
    return x;
  }

 private:
  using Bin = std::array<long, 2>;
  Bin bin(const Vector2& x) const {
    return {std::lround(x[0] / (2.0 * tolerance_)), std::lround(x[1] / (2.0 * tolerance_))};
  }
  double tolerance_;
  std::map<Bin, std::vector<Vector2>> bins_;
};

/// Two sets of closed edges that are being put together.
class Joining {
 public:
  Joining(const Edges& a, const Edges& b, double tolerance)
      : tolerance_(tolerance), vertices_(tolerance), edges_{a, b}, cuts_{Cuts(a.size()), Cuts(b.size())} {
    for (std::size_t side = 0; side < 2; ++side)
      for (const Edge& edge : edges_[side]) boxes_[side].push_back(edge.bounds());
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = 0; j < b.size(); ++j)
        if (near(boxes_[0][i], boxes_[1][j], tolerance_)) cut(i, j);
  }

  /// Of a or b.
  Edges together(const Inside& in_a, const Inside& in_b) {
    Edges kept;
    for (const Edge& piece : pieces(0))
      if (const Place at = place(piece, 1, in_b); at == Place::outside || at == Place::along)
        kept.push_back(piece);
    for (const Edge& piece : pieces(1))
      if (place(piece, 0, in_a) == Place::outside) kept.push_back(piece);
    return kept;
  }
  /// Of a without b.
  Edges without(const Inside& in_a, const Inside& in_b) {
    Edges kept;
    for (const Edge& piece : pieces(0))
      if (const Place at = place(piece, 1, in_b); at == Place::outside || at == Place::against)
        kept.push_back(piece);
    for (const Edge& piece : pieces(1))
      if (place(piece, 0, in_a) == Place::inside) kept.push_back(piece.reversed());
    return kept;
  }

 private:
  using Cuts = std::vector<std::vector<Vector2>>;
  enum class Place { outside, inside, along, against };  // the last two: on an edge of the other

  void cut(std::size_t i, std::size_t j) {
    const Edge &a = edges_[0][i], &b = edges_[1][j];
    for (const Vector2& x : crossings(a, b)) cuts_[0][i].push_back(x), cuts_[1][j].push_back(x);
    for (const double end : {0.0, 1.0}) {
      if (distance(a, b.place(end)) <= tolerance_) cuts_[0][i].push_back(b.place(end));
      if (distance(b, a.place(end)) <= tolerance_) cuts_[1][j].push_back(a.place(end));
    }
  }

  Edges pieces(std::size_t side) {
    Edges list;
    for (std::size_t n = 0; n < edges_[side].size(); ++n) {
      const Edge& edge = edges_[side][n];
      struct Cut {
        double at;
        Vector2 point;
      };
      std::vector<Cut> cuts{{0.0, vertices_.of(edge.place(0.0))}, {1.0, vertices_.of(edge.place(1.0))}};
      for (const Vector2& x : cuts_[side][n]) {
        const Vector2 point = vertices_.of(x);
        if (point != cuts[0].point && point != cuts[1].point) cuts.push_back({edge.nearest(x), point});
      }
      std::ranges::sort(cuts, {}, &Cut::at);
      for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
        if (const Edge piece = edge.piece(cuts[k].at, cuts[k + 1].at, cuts[k].point, cuts[k + 1].point);
            cuts[k].point != cuts[k + 1].point || piece.length() > 4.0 * tolerance_)
          list.push_back(piece);
    }
    return list;
  }

  Place place(const Edge& piece, std::size_t other, const Inside& inside) const {
    Place found = Place::outside;
    for (const double s : {0.5, 0.3}) {  // at one of them the other may touch it
      const Vector2 x = piece.place(s);
      const Edge* edge = edge_at(x, other);
      if (edge == nullptr) return inside(x) ? Place::inside : Place::outside;
      found =
          std::cos(edge->normal(edge->nearest(x)) - piece.normal(s)) > 0.0 ? Place::along : Place::against;
    }
    return found;
  }

  const Edge* edge_at(const Vector2& x, std::size_t side) const {
    for (std::size_t n = 0; n < edges_[side].size(); ++n)
      if (near(boxes_[side][n], {x, x}, tolerance_) && distance(edges_[side][n], x) <= tolerance_)
        return &edges_[side][n];
    return nullptr;
  }

  double tolerance_;
  Vertices vertices_;
  std::array<Edges, 2> edges_;
  std::array<Cuts, 2> cuts_;
  std::array<std::vector<Box>, 2> boxes_;
};

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

}  // namespace

std::vector<Edge> outline(const Region& region) {
  constexpr double relative_tolerance = 1e-12;
  const double tolerance = relative_tolerance * extent(region);
  Edges edges;
  if (const auto* parts = std::get_if<Union>(&region.shape)) {
    for (std::size_t n = 0; n < parts->parts.size(); ++n) {
      const auto before = [&](const Vector2& x) {
        return std::any_of(parts->parts.begin(), parts->parts.begin() + static_cast<std::ptrdiff_t>(n),
                           [&](const Region& part) { return contains(part, x); });
      };
      const auto in_next = [&](const Vector2& x) { return contains(parts->parts[n], x); };
      edges = Joining(edges, edges_of(parts->parts[n], false), tolerance).together(before, in_next);
    }
  } else {
    edges = edges_of(Region(region.shape), false);
  }
  for (std::size_t n = 0; n < region.holes.size(); ++n) {
    const auto left = [&](const Vector2& x) {
      return contains(region.shape, x) &&
             std::none_of(region.holes.begin(), region.holes.begin() + static_cast<std::ptrdiff_t>(n),
                          [&](const Region& hole) { return contains(hole, x); });
    };
    const auto in_hole = [&](const Vector2& x) { return contains(region.holes[n], x); };
    edges = Joining(edges, edges_of(region.holes[n], false), tolerance).without(left, in_hole);
  }
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
