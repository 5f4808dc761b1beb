#pragma once
#include "scene/scene.hpp"

namespace vitrum {

/// Of the part of a region that particles are made in: axisymmetric, of what lies at r > 0. Exact but for the
/// width.
struct ShapeMeasures {
  double area;       ///< m^2
  double moment;     ///< m^3, integral of the first coordinate: axisymmetric, the volume per radian
  double perimeter;  ///< m, of the region's edge
  double width;      ///< m, the shorter side of the box around it
};

ShapeMeasures measures(const Region& region, Geometry geometry);

}  // namespace vitrum
