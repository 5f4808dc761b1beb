#include "scene/lattice_parts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/shapes.hpp"
#include "scene/surface_edges.hpp"

namespace vitrum {
namespace {

using std::numbers::pi;

/// Of a square's area: less is rounding.
constexpr double nothing = 1e-9;

/// What pieces of edge add to a square, and (to_the_right) to each of those right of it in its row. Moments
/// are from each square's own lower left corner.
struct Contribution {
  std::int64_t row, column;
  double area = 0.0;
  Vector2 moment{0.0, 0.0};
  double area_to_the_right = 0.0, y_moment_to_the_right = 0.0;
};

/// Collects the contributions of an edge that runs counter-clockwise around its shape. Lengths are in
/// spacings.
class EdgeWalk {
 public:
  /// A straight piece, cut where it crosses lines of the lattice.
  void line(const Vector2& from, const Vector2& to) {
    const auto at = [&](double t) {
      return Vector2{std::lerp(from[0], to[0], t), std::lerp(from[1], to[1], t)};
    };
    std::vector<Cut> cuts{{0.0, from}, {1.0, to}};
    for (std::size_t k = 0; k < 2; ++k) {
      const double low = std::min(from[k], to[k]), high = std::max(from[k], to[k]);
      for (double line = std::floor(low) + 1.0; line < high; ++line)
        cuts.push_back(cut_at((line - from[k]) / (to[k] - from[k]), at, k, line));
    }
    std::ranges::sort(cuts, {}, &Cut::at);
    for (std::size_t n = 0; n + 1 < cuts.size(); ++n)
      add_chord(square_at(at(0.5 * (cuts[n].at + cuts[n + 1].at))), cuts[n].point, cuts[n + 1].point);
  }

  /// A whole circle; sense -1: around a hole.
  void circle(const Vector2& centre, double radius, double sense) {
    const Vector2 leftmost{centre[0] - radius, centre[1]};
    arc(centre, radius, sense, {-pi, leftmost}, {pi, leftmost});
  }

  /// An arc between two angles, which may pass pi, and its ends.
  void arc_between(const Vector2& centre, double radius, double sense, double first, double angle,
                   const Vector2& start, const Vector2& end) {
    const double from = first - 2.0 * pi * std::floor((first + pi) / (2.0 * pi)), to = from + angle;
    if (to <= pi) return arc(centre, radius, sense, {from, start}, {to, end});
    const Vector2 leftmost{centre[0] - radius, centre[1]};
    arc(centre, radius, sense, {from, start}, {pi, leftmost});
    arc(centre, radius, sense, {-pi, leftmost}, {to - 2.0 * pi, end});
  }

  /// The parts of all squares, by row, then column.
  std::vector<LatticePart> parts();

 private:
  /// Where an edge is cut: parameter, and the point, which lies exactly on the line of the lattice, so that
  /// the pieces of a row end at the same heights.
  struct Cut {
    double at;
    Vector2 point;
  };

  /// Within -pi and pi.
  void arc(const Vector2& centre, double radius, double sense, const Cut& first, const Cut& last) {
    const auto at = [&](double angle) {
      return Vector2{centre[0] + radius * std::cos(angle), centre[1] + radius * std::sin(angle)};
    };
    std::vector<Cut> cuts{first, last};
    for (const double angle : {-0.5 * pi, 0.0, 0.5 * pi}) cuts.push_back({angle, at(angle)});
    for (double x = std::floor(centre[0] - radius) + 1.0; x < centre[0] + radius; ++x) {
      const double angle = std::acos(std::clamp((x - centre[0]) / radius, -1.0, 1.0));
      for (const double a : {-angle, angle}) cuts.push_back(cut_at(a, at, 0, x));
    }
    for (double y = std::floor(centre[1] - radius) + 1.0; y < centre[1] + radius; ++y) {
      const double angle = std::asin(std::clamp((y - centre[1]) / radius, -1.0, 1.0));
      for (const double a : {angle, std::copysign(pi, angle) - angle}) cuts.push_back(cut_at(a, at, 1, y));
    }
    std::erase_if(cuts, [&](const Cut& c) { return c.at < first.at || c.at > last.at; });
    std::ranges::sort(cuts, {}, &Cut::at);
    for (std::size_t n = 0; n + 1 < cuts.size(); ++n) {
      const double middle = 0.5 * (cuts[n].at + cuts[n + 1].at), half = 0.5 * (cuts[n + 1].at - cuts[n].at);
      Contribution& square = square_at(at(middle));
      sense > 0.0 ? add_chord(square, cuts[n].point, cuts[n + 1].point)
                  : add_chord(square, cuts[n + 1].point, cuts[n].point);
      add_segment(square, centre, radius, middle, half, sense);
    }
  }

  template <class Curve>
  static Cut cut_at(double at, const Curve& curve, std::size_t component, double line) {
    Vector2 point = curve(at);
    point[component] = line;
    return {at, point};
  }

  Contribution& square_at(const Vector2& x) {
    return pieces_.emplace_back(Contribution{static_cast<std::int64_t>(std::floor(x[1])),
                                             static_cast<std::int64_t>(std::floor(x[0]))});
  }

  /// A straight piece within a square: what lies between it and the square's right side (less where the shape
  /// is left of it), and between the sides of the squares beyond.
  static void add_chord(Contribution& c, const Vector2& from, const Vector2& to) {
    const double x0 = from[0] - static_cast<double>(c.column), x1 = to[0] - static_cast<double>(c.column);
    const double y0 = from[1] - static_cast<double>(c.row), y1 = to[1] - static_cast<double>(c.row);
    const double dy = y0 - y1, y_dy = 0.5 * (y0 + y1) * dy;
    c.area += dy - 0.5 * (x0 + x1) * dy;
    c.moment[0] += 0.5 * dy * (1.0 - (x0 * x0 + x0 * x1 + x1 * x1) / 3.0);
    c.moment[1] += y_dy - dy * (x0 * (2.0 * y0 + y1) + x1 * (y0 + 2.0 * y1)) / 6.0;
    c.area_to_the_right += dy;
    c.y_moment_to_the_right += y_dy;
  }

  /// The segment between an arc of 2 `half` about the angle `middle`, within a square, and its chord.
  static void add_segment(Contribution& c, const Vector2& centre, double radius, double middle, double half,
                          double sense) {
    const double s = std::sin(half), area = sense * radius * radius * (half - s * std::cos(half));
    const double from_centre = sense * radius * radius * radius * (2.0 / 3.0) * s * s * s;
    c.area += area;
    c.moment[0] += area * (centre[0] - static_cast<double>(c.column)) + from_centre * std::cos(middle);
    c.moment[1] += area * (centre[1] - static_cast<double>(c.row)) + from_centre * std::sin(middle);
  }

  std::vector<Contribution> pieces_;
};

/// A part, unless it is nothing.
void keep(std::vector<LatticePart>& parts, const LatticePart& part) {
  if (std::abs(part.area - 1.0) < nothing)
    parts.push_back({part.row, part.column, 1.0, {0.5, 0.5}});
  else if (part.area > nothing)
    parts.push_back(part);
}

std::vector<LatticePart> EdgeWalk::parts() {
  std::ranges::stable_sort(pieces_, {}, [](const Contribution& c) { return std::pair(c.row, c.column); });
  std::vector<LatticePart> parts;
  double inside = 0.0, y_moment = 0.0;  // of a square without edge, at the present place in the row
  for (std::size_t n = 0; n < pieces_.size();) {
    const std::int64_t row = pieces_[n].row, column = pieces_[n].column;
    LatticePart part{row, column, inside, {0.5 * inside, y_moment}};
    for (; n < pieces_.size() && pieces_[n].row == row && pieces_[n].column == column; ++n) {
      const Contribution& c = pieces_[n];
      part.area += c.area, part.moment[0] += c.moment[0], part.moment[1] += c.moment[1];
      inside += c.area_to_the_right, y_moment += c.y_moment_to_the_right;
    }
    keep(parts, part);
    if (n == pieces_.size() || pieces_[n].row != row) {
      inside = y_moment = 0.0;
      continue;
    }
    if (inside > nothing)
      for (std::int64_t i = column + 1; i < pieces_[n].column; ++i)
        keep(parts, {row, i, inside, {0.5 * inside, y_moment}});
  }
  return parts;
}

void walk(EdgeWalk& edge, const Box& b, double scale) {
  const double x0 = b.min[0] * scale, y0 = b.min[1] * scale, x1 = b.max[0] * scale, y1 = b.max[1] * scale;
  edge.line({x0, y0}, {x1, y0}), edge.line({x1, y0}, {x1, y1});
  edge.line({x1, y1}, {x0, y1}), edge.line({x0, y1}, {x0, y0});
}
void walk(EdgeWalk& edge, const Disk& d, double scale) {
  edge.circle({d.centre[0] * scale, d.centre[1] * scale}, d.radius * scale, 1.0);
}
void walk(EdgeWalk& edge, const Ring& r, double scale) {
  edge.circle({r.centre[0] * scale, r.centre[1] * scale}, r.outer * scale, 1.0);
  edge.circle({r.centre[0] * scale, r.centre[1] * scale}, r.inner * scale, -1.0);
}
void walk(EdgeWalk& edge, const Polygon& p, double scale) {
  double twice_area = 0.0;
  for (std::size_t i = 0, j = p.vertices.size() - 1; i < p.vertices.size(); j = i++)
    twice_area += (p.vertices[j][0] - p.vertices[0][0]) * (p.vertices[i][1] - p.vertices[0][1]) -
                  (p.vertices[i][0] - p.vertices[0][0]) * (p.vertices[j][1] - p.vertices[0][1]);
  for (std::size_t i = 0, j = p.vertices.size() - 1; i < p.vertices.size(); j = i++) {
    const Vector2 a{p.vertices[j][0] * scale, p.vertices[j][1] * scale};
    const Vector2 b{p.vertices[i][0] * scale, p.vertices[i][1] * scale};
    twice_area > 0.0 ? edge.line(a, b) : edge.line(b, a);
  }
}

void walk(EdgeWalk& walked, const std::vector<Edge>& edges, double scale) {
  const auto scaled = [scale](const Vector2& x) { return Vector2{x[0] * scale, x[1] * scale}; };
  for (const Edge& edge : edges) {
    const Vector2 start = scaled(edge.place(0.0)), end = scaled(edge.place(1.0));
    if (edge.is_arc())
      walked.arc_between(scaled(edge.circle().centre), edge.circle().radius * scale,
                         edge.outward() ? 1.0 : -1.0, edge.first(), edge.angle(), start, end);
    else
      walked.line(start, end);
  }
}
void walk(EdgeWalk& walked, const Image& image, double scale) {
  walk(walked, edges_of(image, false), scale);
}
void walk(EdgeWalk& walked, const Union& together, double scale) {
  walk(walked, edges_of(together, false), scale);
}

}  // namespace

std::vector<LatticePart> lattice_parts(const Region& region, double spacing) {
  EdgeWalk edge;
  if (region.holes.empty())
    std::visit([&](const auto& s) { walk(edge, s, 1.0 / spacing); }, region.shape);
  else
    walk(edge, edges_of(region, false), 1.0 / spacing);
  return edge.parts();
}

}  // namespace vitrum
