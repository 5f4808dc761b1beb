#pragma once

namespace vitrum::mpm {

enum class ShapeKind { linear, gimp, cpgimp, bspline2 };

}  // namespace vitrum::mpm
