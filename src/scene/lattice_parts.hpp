#pragma once
#include <cstdint>
#include <vector>

#include "scene/scene.hpp"

namespace vitrum {

/// What one or more squares of a lattice hold of a shape, in units of the lattice's spacing.
struct LatticePart {
  std::int64_t row, column;  ///< of the (largest) square: [column, column + 1] x [row, row + 1]
  double area;
  Vector2 moment;  ///< integral of x and y over the part, from the square's lower left corner
};

/// The exact parts of a region in the squares of the lattice of that spacing (m) through the origin, by row,
/// then column. Green's theorem along the region's edge, which is cut at the lattice's lines: straight pieces
/// as they are, arcs as their chords and the segments of a circle between chord and arc. Parts below 1e-9 of
/// a square are nothing, and those within 1e-9 of a whole one are whole.
std::vector<LatticePart> lattice_parts(const Region& region, double spacing);

/// Of a square's area: a part that is smaller makes no particle of its own.
inline constexpr double small_part = 0.25;

/// Hands small parts over to the largest of their neighbours (to equal ones in equal shares), the smallest
/// first, until none is left that has a neighbour: sums of area and moment stay.
void join_small_parts(std::vector<LatticePart>& parts);

}  // namespace vitrum
