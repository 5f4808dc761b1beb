#pragma once
#include "scene/scene.hpp"

namespace vitrum {

/// Distance between the edges of two shapes that do not overlap, m; 0 where they touch. A shape in the hole
/// of a ring is as far from it as from its inner circle.
double gap(const Shape& a, const Shape& b);

}  // namespace vitrum
