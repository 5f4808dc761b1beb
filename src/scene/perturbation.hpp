#pragma once
#include <cstddef>
#include <vector>

#include "scene/scene.hpp"

namespace vitrum {

/// Displacements (m) of `count` particles, uniform and independent in both components; all zero for amplitude
/// zero. The same seed gives the same bits on every platform.
std::vector<Vector2> displacements(const Perturbation& perturbation, double cell, std::size_t count);

}  // namespace vitrum
