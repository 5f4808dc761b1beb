#pragma once

namespace vitrum::mpm {

enum class ShapeKind { linear, gimp, bspline2 };

}  // namespace vitrum::mpm
