#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "mpm/system.hpp"
#include "scene/scene.hpp"

namespace vitrum {

/// Column and row of a node of the grid.
using NodeIndex = std::array<std::int64_t, 2>;

/// The nodes inside a box (m; within rounding of its sides, too) in which a body's particles have a share as
/// they stand, sorted; a node that gets less than 1e-9 of each of them counts as none. Axisymmetric: those at
/// r >= 0.
std::vector<NodeIndex> nodes_of(const System& system, const Body& body, const Box& box);

/// How many two lists have in common.
std::size_t count_common(const std::vector<NodeIndex>& a, const std::vector<NodeIndex>& b);

}  // namespace vitrum
