#pragma once
#include <optional>

#include "scene/scene.hpp"

namespace vitrum {

/// Smallest box around a shape, m.
Box bounds(const Shape& shape);
/// Whether a shape's inside holds a point (m); a point on the edge may count either way.
bool contains(const Shape& shape, const Vector2& point);
/// A point (m) well inside both shapes: `tolerance` (m) from either's edge. Searched on a lattice of spacing
/// `resolution` (m; coarser where that would take over a million points): nothing does not exclude an overlap
/// that is narrower.
std::optional<Vector2> common_point(const Shape& a, const Shape& b, double resolution, double tolerance);

}  // namespace vitrum
