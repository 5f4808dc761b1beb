#include "scene/seeding.hpp"

#include <algorithm>
#include <cmath>

#include "scene/shapes.hpp"

namespace vitrum {
namespace {

/// Where the horizontal line at height y crosses the polygon, from left to right: inside is to the right of
/// an odd number of crossings.
void find_crossings(const Polygon& p, double y, std::vector<double>& crossings) {
  crossings.clear();
  for (std::size_t i = 0, j = p.vertices.size() - 1; i < p.vertices.size(); j = i++) {
    const Vector2 &a = p.vertices[i], &b = p.vertices[j];
    if ((a[1] > y) != (b[1] > y)) crossings.push_back((b[0] - a[0]) * (y - a[1]) / (b[1] - a[1]) + a[0]);
  }
  std::sort(crossings.begin(), crossings.end());
}

std::vector<Seed> seed(const Box& box, double spacing) {
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

std::vector<Seed> seed(const Polygon& polygon, double spacing) {
  const Box box = bounds(polygon);
  std::vector<Seed> seeds;
  std::vector<double> crossings;
  for (auto j = static_cast<long long>(std::floor(box.min[1] / spacing)),
            end = static_cast<long long>(std::ceil(box.max[1] / spacing));
       j < end; ++j) {
    const double y = (static_cast<double>(j) + 0.5) * spacing;
    find_crossings(polygon, y, crossings);
    for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
      for (auto i = static_cast<long long>(std::floor(crossings[k] / spacing)) - 1;; ++i) {
        const double x = (static_cast<double>(i) + 0.5) * spacing;
        if (!(x < crossings[k + 1])) break;
        if (x >= crossings[k]) seeds.push_back({{x, y}, spacing * spacing});
      }
  }
  return seeds;
}

template <class Curved>
std::vector<Seed> seed(const Curved& shape, double spacing) {
  const Shape whole(shape);
  const Box box = bounds(whole);
  const auto first = [&](double low) { return static_cast<long long>(std::floor(low / spacing)); };
  const auto last = [&](double high) { return static_cast<long long>(std::ceil(high / spacing)); };
  std::vector<Seed> seeds;
  for (long long j = first(box.min[1]); j < last(box.max[1]); ++j)
    for (long long i = first(box.min[0]); i < last(box.max[0]); ++i) {
      const Vector2 x{(static_cast<double>(i) + 0.5) * spacing, (static_cast<double>(j) + 0.5) * spacing};
      if (contains(whole, x)) seeds.push_back({x, spacing * spacing});
    }
  return seeds;
}

}  // namespace

double most_seeds(const Shape& shape, double cell, int per_side) {
  const Box box = bounds(shape);
  const double spacing = cell / per_side;
  return ((box.max[0] - box.min[0]) / spacing + 2.0) * ((box.max[1] - box.min[1]) / spacing + 2.0);
}

double reach(const Shape& shape) {
  const Box box = bounds(shape);
  return std::max({std::abs(box.min[0]), std::abs(box.min[1]), std::abs(box.max[0]), std::abs(box.max[1])});
}

std::vector<Seed> seed_shape(const Shape& shape, double cell, int per_side) {
  return std::visit([&](const auto& s) { return seed(s, cell / per_side); }, shape);
}

}  // namespace vitrum
