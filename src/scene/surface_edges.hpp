#pragma once
#include <vector>

#include "scene/scene.hpp"

namespace vitrum {

/// A straight edge or an arc of a body's exact surface, by a parameter from 0 to 1.
class Edge {
 public:
  /// The body lies to its left.
  static Edge line(const Vector2& from, const Vector2& to);
  /// An arc from an angle on, counter-clockwise. outward: the body lies inside the circle.
  static Edge arc(const Disk& circle, double first, double angle, bool outward);

  double length() const { return length_; }  ///< m
  Vector2 place(double s) const;             ///< m
  double normal(double s) const;             ///< rad, of the outward normal, counter-clockwise from r
  /// Into how many pieces of about a spacing (m) it is cut.
  int pieces(double spacing) const;
  /// Parameters at which a component of the place passes a value, and possibly others.
  std::vector<double> crossings(std::size_t component, double value) const;

 private:
  bool is_arc_ = false, outward_ = true;
  Vector2 from_{}, way_{};
  Disk circle_{};
  double first_ = 0.0, angle_ = 0.0, length_ = 0.0;
};

/// The edges of a shape. axisymmetric: of circles centred on the axis the half beyond it.
std::vector<Edge> edges_of(const Shape& shape, bool axisymmetric);

}  // namespace vitrum
