#pragma once
#include <vector>

#include "scene/scene.hpp"

namespace vitrum {

/// A straight edge or an arc of a shape's exact edge, by a parameter from 0 to 1. Its ends are points of
/// their own, exactly those of the edges that meet it there.
class Edge {
 public:
  /// The body lies to its left.
  static Edge line(const Vector2& from, const Vector2& to);
  /// An arc from an angle on, counter-clockwise. outward: the body lies inside the circle.
  static Edge arc(const Disk& circle, double first, double angle, bool outward);

  double length() const { return length_; }  ///< m
  Vector2 place(double s) const;             ///< m
  double normal(double s) const;             ///< rad, of the outward normal, counter-clockwise from r
  bool is_arc() const { return is_arc_; }
  /// Of an arc: its circle, the angle that it begins at, and how far it goes (rad), counter-clockwise.
  const Disk& circle() const { return circle_; }
  double first() const { return first_; }
  double angle() const { return angle_; }
  /// With the body to the left it runs as its parameter does; else, an arc about a hole, against it.
  bool outward() const { return outward_; }
  /// Whether it bounds a hole.
  bool inner() const { return inner_; }
  void set_inner(bool inner) { inner_ = inner; }

  /// Into how many pieces of about a spacing (m) it is cut.
  int pieces(double spacing) const;
  /// Parameters at which a component of the place passes a value, and possibly others.
  std::vector<double> crossings(std::size_t component, double value) const;
  /// Parameters at which the normal passes from one side to the next (Side), and possibly others.
  std::vector<double> corners() const;
  /// The parameter of the place that is nearest to a point, m.
  double nearest(const Vector2& x) const;
  /// The piece between two parameters, whose ends are given.
  Edge piece(double from, double to, const Vector2& start, const Vector2& end) const;
  /// The edge of what lies beyond it.
  Edge reversed() const;
  /// Smallest box around it, m.
  Box bounds() const;

 private:
  bool is_arc_ = false, outward_ = true, inner_ = false;
  Vector2 from_{}, to_{};
  Disk circle_{};
  double first_ = 0.0, angle_ = 0.0, length_ = 0.0;
};

/// Distance of a point from an edge, m.
double distance(const Edge& edge, const Vector2& x);
/// Points at which two edges cross, m; of edges that run along each other, none.
std::vector<Vector2> crossings(const Edge& a, const Edge& b);

/// The edges of a region. axisymmetric: of what lies beyond the axis.
std::vector<Edge> edges_of(const Region& region, bool axisymmetric);

}  // namespace vitrum
