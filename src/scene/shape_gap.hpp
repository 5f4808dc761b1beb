#pragma once
#include "scene/scene.hpp"

namespace vitrum {

/// Distance between the edges of two regions that do not overlap, m; 0 where they touch. A region in the hole
/// of another is as far from it as from the edge of the hole.
double gap(const Region& a, const Region& b);

}  // namespace vitrum
