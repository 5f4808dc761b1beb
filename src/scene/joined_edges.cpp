#include "scene/joined_edges.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace vitrum {
namespace {

double apart(const Vector2& a, const Vector2& b) {
  return std::hypot(b[0] - a[0], b[1] - a[1]);
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

/// Two sets of closed edges, cut where they meet.
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

  enum class Place { outside, inside, along, against };  // the last two: on an edge of the other

  /// Of each edge of a side, its pieces at either of two places.
  std::vector<Edges> pieces_at(Place one, Place another, std::size_t side, const Inside& in_other) {
    std::vector<Edges> kept;
    for (const Edges& pieces : all_pieces(side)) {
      kept.emplace_back();
      for (const Edge& piece : pieces)
        if (const Place at = place(piece, 1 - side, in_other); at == one || at == another)
          kept.back().push_back(piece);
    }
    return kept;
  }

 private:
  using Cuts = std::vector<std::vector<Vector2>>;

  void cut(std::size_t i, std::size_t j) {
    const Edge &a = edges_[0][i], &b = edges_[1][j];
    for (const Vector2& x : crossings(a, b)) cuts_[0][i].push_back(x), cuts_[1][j].push_back(x);
    for (const double end : {0.0, 1.0}) {
      if (distance(a, b.place(end)) <= tolerance_) cuts_[0][i].push_back(b.place(end));
      if (distance(b, a.place(end)) <= tolerance_) cuts_[1][j].push_back(a.place(end));
    }
  }

  std::vector<Edges> all_pieces(std::size_t side) {
    std::vector<Edges> list;
    for (std::size_t n = 0; n < edges_[side].size(); ++n)
      list.push_back(pieces(edges_[side][n], cuts_[side][n]));
    return list;
  }

  Edges pieces(const Edge& edge, const std::vector<Vector2>& points) {
    struct Cut {
      double at;
      Vector2 point;
    };
    std::vector<Cut> cuts{{0.0, vertices_.of(edge.place(0.0))}, {1.0, vertices_.of(edge.place(1.0))}};
    for (const Vector2& x : points) {
      const Vector2 point = vertices_.of(x);
      if (point != cuts[0].point && point != cuts[1].point) cuts.push_back({edge.nearest(x), point});
    }
    std::ranges::sort(cuts, {}, &Cut::at);
    Edges list;
    for (std::size_t k = 0; k + 1 < cuts.size(); ++k)
      if (const Edge piece = edge.piece(cuts[k].at, cuts[k + 1].at, cuts[k].point, cuts[k + 1].point);
          cuts[k].point != cuts[k + 1].point || piece.length() > 4.0 * tolerance_)
        list.push_back(piece);
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

using Place = Joining::Place;

Edges flat(const std::vector<Edges>& lists) {
  Edges all;
  for (const Edges& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

}  // namespace

bool near(const Box& a, const Box& b, double reach) {
  bool result = true;
  for (std::size_t c = 0; c < 2; ++c)
    result = result && a.min[c] <= b.max[c] + reach && b.min[c] <= a.max[c] + reach;
  return result;
}

Joined together(const Edges& a, const Inside& in_a, const Edges& b, const Inside& in_b, double tolerance) {
  Joining joining(a, b, tolerance);
  Joined left;
  left.a = joining.pieces_at(Place::outside, Place::along, 0, in_b);
  left.b = flat(joining.pieces_at(Place::outside, Place::outside, 1, in_a));
  return left;
}

Joined without(const Edges& a, const Inside& in_a, const Edges& b, const Inside& in_b, double tolerance) {
  Joining joining(a, b, tolerance);
  Joined left;
  left.a = joining.pieces_at(Place::outside, Place::against, 0, in_b);
  for (const Edge& piece : flat(joining.pieces_at(Place::inside, Place::inside, 1, in_a)))
    left.b.push_back(piece.reversed());
  return left;
}

}  // namespace vitrum
