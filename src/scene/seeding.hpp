#pragma once
#include <vector>

#include "scene/scene.hpp"

namespace vitrum {

/// A particle to be: centroid (m) and area (m^2) of its square, its rectangle, or its part of the shape.
struct Seed {
  Vector2 position;
  double area;
};

/// No fewer particles than seed_shape would make.
double most_seeds(const Region& region, double cell, int per_side);

/// Largest coordinate, positive or negative, that a region reaches, m.
double reach(const Region& region);

/// Fills a region with particles, `per_side` x `per_side` per cell, whose areas and first moments add up to
/// the region's. A whole box is divided evenly from its own corner. Other shapes take the squares of the
/// grid's own lattice; where the shape's edge crosses one, its particle has the area of the part inside and
/// stands at that part's centroid, and parts of less than a quarter of a square go to their neighbours.
/// Axisymmetric: of what lies at r > 0. Nothing when a shape other than a box has less than a quarter of a
/// square in all.
std::vector<Seed> seed_shape(const Region& region, double cell, int per_side, Geometry geometry);

}  // namespace vitrum
