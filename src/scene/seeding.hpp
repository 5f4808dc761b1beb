#pragma once
#include <vector>

#include "scene/scene.hpp"

namespace vitrum {

/// A particle to be: centre (m) and area of its square or rectangle (m^2).
struct Seed {
  Vector2 position;
  double area;
};

/// The smallest box around a shape.
Box bounds(const Shape& shape);

/// No fewer particles than seed_shape would make.
double most_seeds(const Shape& shape, double cell, int per_side);

/// Largest coordinate, positive or negative, that a shape reaches, m.
double reach(const Shape& shape);

/// Fills a shape with particles, `per_side` x `per_side` per cell. A box is divided evenly from its own
/// corner, so that its area is exact; other shapes take the points of the grid's own lattice that lie inside.
std::vector<Seed> seed_shape(const Shape& shape, double cell, int per_side);

}  // namespace vitrum
