#include "scene/seeding.hpp"

#include <algorithm>
#include <cmath>

#include "scene/lattice_parts.hpp"
#include "scene/shapes.hpp"

namespace vitrum {
namespace {

std::vector<Seed> divided(const Box& box, double spacing) {
  std::array<long, 2> count{};
  std::array<double, 2> step{};
  for (std::size_t k = 0; k < 2; ++k) {
    const double side = box.max[k] - box.min[k];
    count[k] = std::max(1L, std::lround(side / spacing));
    step[k] = side / static_cast<double>(count[k]);
  }
  std::vector<Seed> seeds;
  seeds.reserve(static_cast<std::size_t>(count[0] * count[1]));
  for (long j = 0; j < count[1]; ++j)
    for (long i = 0; i < count[0]; ++i)
      seeds.push_back({{box.min[0] + (static_cast<double>(i) + 0.5) * step[0],
                        box.min[1] + (static_cast<double>(j) + 0.5) * step[1]},
                       step[0] * step[1]});
  return seeds;
}

/// Squares of the grid's own lattice: whole ones, and the parts of those that the region's edge crosses.
std::vector<Seed> seed(const Region& region, double spacing, Geometry geometry) {
  std::vector<LatticePart> parts = lattice_parts(region, spacing);
  // A disk about a point of the axis stands for a sphere: what lies at r < 0 is its mirror image.
  if (geometry == Geometry::axisymmetric)
    std::erase_if(parts, [](const LatticePart& p) { return p.column < 0; });
  join_small_parts(parts);
  if (parts.size() == 1 && parts.front().area < small_part) return {};
  std::vector<Seed> seeds;
  seeds.reserve(parts.size());
  for (const LatticePart& p : parts)
    seeds.push_back({{(static_cast<double>(p.column) + p.moment[0] / p.area) * spacing,
                      (static_cast<double>(p.row) + p.moment[1] / p.area) * spacing},
                     p.area * (spacing * spacing)});
  return seeds;
}

}  // namespace

double most_seeds(const Region& region, double cell, int per_side) {
  const Box box = bounds(region);
  const double spacing = cell / per_side;
  return ((box.max[0] - box.min[0]) / spacing + 2.0) * ((box.max[1] - box.min[1]) / spacing + 2.0);
}

double reach(const Region& region) {
  const Box box = bounds(region);
  return std::max({std::abs(box.min[0]), std::abs(box.min[1]), std::abs(box.max[0]), std::abs(box.max[1])});
}

std::vector<Seed> seed_shape(const Region& region, double cell, int per_side, Geometry geometry) {
  const auto* box = std::get_if<Box>(&region.shape);
  return box != nullptr && region.holes.empty() ? divided(*box, cell / per_side)
                                                : seed(region, cell / per_side, geometry);
}

}  // namespace vitrum
