#pragma once
#include <optional>

#include "scene/scene.hpp"

namespace vitrum {

/// Whether a region is made of several shapes.
bool is_composed(const Region& region);
/// Smallest box around a region without its holes, m.
Box bounds(const Region& region);
/// Whether a region's inside holds a point (m); a point on the edge may count either way.
bool contains(const Region& region, const Vector2& point);
/// A point (m) well inside both regions: `tolerance` (m) from either's edge. Searched on a lattice of spacing
/// `resolution` (m; coarser where that would take over a million points): nothing does not exclude an overlap
/// that is narrower.
std::optional<Vector2> common_point(const Region& a, const Region& b, double resolution, double tolerance);

}  // namespace vitrum
