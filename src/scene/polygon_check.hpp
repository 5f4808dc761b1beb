#pragma once
#include <span>
#include <string>

#include "scene/scene.hpp"

namespace vitrum::scene {

/// What is wrong with a closed polygon, as a phrase ("edges 0 and 2 that cross or touch"); empty when it is
/// simple and encloses an area. Distances below 1e-12 of the polygon's extent count as zero.
std::string polygon_fault(std::span<const Vector2> vertices);

}  // namespace vitrum::scene
