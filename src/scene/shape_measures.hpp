#pragma once
#include "scene/scene.hpp"

namespace vitrum {

/// Of the part of a shape that particles are made in.
struct ShapeMeasures {
  double area;       ///< m^2
  double perimeter;  ///< m
  double width;      ///< m, the shorter side of the box around it
};

/// Circles across the axis count with the share of their diameter that lies at r > 0.
ShapeMeasures measures(const Shape& shape, Geometry geometry);

}  // namespace vitrum
