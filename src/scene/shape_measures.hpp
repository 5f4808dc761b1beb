#pragma once
#include "scene/scene.hpp"

namespace vitrum {

/// Of the part of a shape that particles are made in: axisymmetric, of what lies at r > 0. Exact but for the
/// width.
struct ShapeMeasures {
  double area;       ///< m^2
  double moment;     ///< m^3, integral of the first coordinate: axisymmetric, the volume per radian
  double perimeter;  ///< m, of the shape's edge
  double width;      ///< m, the shorter side of the box around it
};

ShapeMeasures measures(const Shape& shape, Geometry geometry);

}  // namespace vitrum
