#include "scene/seeding.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/shape_measures.hpp"
#include "scene/shapes.hpp"
#include "support/random_states.hpp"
#include "tests/catch.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

/// A star about a point, whose rows enter and leave it many times, in either sense.
Polygon star(Random& random, const Vector2& centre, double size, int corners) {
  Polygon p;
  const double sense = random.uniform(-1.0, 1.0) < 0.0 ? -1.0 : 1.0;
  for (int k = 0; k < corners; ++k) {
    const double angle = sense * 2.0 * std::numbers::pi * k / corners, r = size * random.uniform(0.2, 1.0);
    p.vertices.push_back({centre[0] + r * std::cos(angle), centre[1] + r * std::sin(angle)});
  }
  return p;
}

/// Anywhere in a cell, of 0.6 to 6 cells; every fifth on lattice lines. Axisymmetric: at r >= 0, disks and
/// rings across the axis.
Shape random_shape(Random& random, Geometry geometry, int number) {
  const bool round = number % 5 == 0, at_axis = geometry == Geometry::axisymmetric;
  const auto on_lattice = [&](double x) { return round ? 0.5 * std::round(2.0 * x) : x; };
  const double size = std::max(on_lattice(random.uniform(0.6, 6.0)), 0.6);
  const Vector2 centre{on_lattice(random.uniform(at_axis ? 0.0 : -40.0, at_axis ? 8.0 : 40.0)),
                       on_lattice(random.uniform(-40.0, 40.0))};
  switch (number % 4) {
    case 0:
      return Box{{centre[0], centre[1]},
                 {centre[0] + size, centre[1] + on_lattice(random.uniform(0.5, 6.0))}};
    case 1:
      return Disk{centre, size};
    case 2:
      return Ring{centre, size * random.uniform(0.0, 0.9), size};
    default:
      return star(random, {centre[0] + (at_axis ? size : 0.0), centre[1]}, size,
                  3 + static_cast<int>(random.uniform(0.0, 12.0)));
  }
}

struct Sums {
  double area = 0.0, moment = 0.0, least = 1e300;
};
Sums sums_of(const std::vector<Seed>& seeds) {
  Sums s;
  for (const Seed& seed : seeds) {
    s.area += seed.area, s.moment += seed.area * seed.position[0];
    s.least = std::min(s.least, seed.area);
  }
  return s;
}

}  // namespace

TEST_CASE("particles have the area and the volume of their shape, wherever it stands in the cells",
          "[scene]") {
  Random random(5);
  for (const Geometry geometry : {Geometry::plane_strain, Geometry::axisymmetric})
    for (int number = 0; number < 2000; ++number) {
      const Shape shape = random_shape(random, geometry, number);
      const int per_side = 1 + number / 4 % 4;
      const ShapeMeasures exact = measures(shape, geometry);
      const std::vector<Seed> seeds = seed_shape(shape, 1.0, per_side, geometry);
      const Sums found = sums_of(seeds);
      const double square = 1.0 / (per_side * per_side);
      CAPTURE(number, shape.index(), per_side, exact.area, seeds.size());
      if (seeds.empty()) {
        CHECK(exact.area < 0.25 * square);
        continue;
      }
      CHECK(found.area == Approx(exact.area).epsilon(1e-7));
      CHECK(std::abs(found.moment - exact.moment) < 1e-7 * exact.area * (1.0 + reach(shape)));
      if (shape.index() != 0) CHECK(found.least >= 0.25 * square * (1.0 - 1e-9));
      CHECK(static_cast<double>(seeds.size()) <= most_seeds(shape, 1.0, per_side));
    }
}

TEST_CASE("squares that a disk covers make whole particles at their centres", "[scene]") {
  Random random(7);
  for (int number = 0; number < 200; ++number) {
    const Shape shape = random_shape(random, Geometry::plane_strain, 4 * number + 1);  // disks
    const Box box = bounds(shape);
    const std::vector<Seed> seeds = seed_shape(shape, 0.5, 1, Geometry::plane_strain);
    for (double y = std::floor(box.min[1]) + 0.25; y < box.max[1]; y += 0.5)
      for (double x = std::floor(box.min[0]) + 0.25; x < box.max[0]; x += 0.5) {
        // A square so far inside that none of its neighbours is cut has taken nothing over.
        bool covered = true;
        for (const double dy : {-0.75, 0.75})
          for (const double dx : {-0.75, 0.75}) covered = covered && contains(shape, {x + dx, y + dy});
        if (!covered) continue;
        const Vector2 centre{x, y};
        CHECK(std::ranges::count_if(
                  seeds, [&](const Seed& s) { return s.position == centre && s.area == 0.25; }) == 1);
      }
  }
}

TEST_CASE("particles of a disk about a node or a centre of cells are mirror images", "[scene]") {
  for (const double centre : {0.0, 0.5})
    for (double radius = 0.8; radius < 9.0; radius += 0.137) {
      const std::vector<Seed> seeds =
          seed_shape(Disk{{centre, centre}, radius}, 1.0, 1, Geometry::plane_strain);
      const auto has = [&](double x, double y, double area) {
        return std::ranges::any_of(seeds, [&](const Seed& s) {
          return std::abs(s.position[0] - centre - x) + std::abs(s.position[1] - centre - y) +
                     std::abs(s.area - area) <
                 1e-9;
        });
      };
      bool mirrored = true;
      for (const Seed& s : seeds) {
        const double x = s.position[0] - centre, y = s.position[1] - centre;
        mirrored = mirrored && has(-x, y, s.area) && has(x, -y, s.area) && has(y, x, s.area);
      }
      CAPTURE(centre, radius);
      CHECK(mirrored);
    }
}

TEST_CASE("a band thinner than a particle's square has few particles of its own area", "[scene]") {
  const Polygon band{{{0.2, 0.3}, {500.2, 0.8}, {500.2, 0.81}, {0.2, 0.31}}};
  const std::vector<Seed> seeds = seed_shape(band, 1.0, 1, Geometry::plane_strain);
  CHECK(sums_of(seeds).area == Approx(5.0).epsilon(1e-7));
  CHECK(sums_of(seeds).least >= 0.25);
  CHECK(seeds.size() <= 20);
}

TEST_CASE("measures of shapes across the axis are those of the half that is meant", "[scene]") {
  constexpr double pi = std::numbers::pi;
  const ShapeMeasures sphere = measures(Disk{{0.0, 3.0}, 2.0}, Geometry::axisymmetric);
  CHECK(sphere.area == Approx(2.0 * pi));
  CHECK(2.0 * pi * sphere.moment == Approx(4.0 / 3.0 * pi * 8.0));
  // Pappus.
  CHECK(measures(Disk{{5.0, 0.0}, 2.0}, Geometry::axisymmetric).moment == Approx(4.0 * pi * 5.0));
  CHECK(measures(Ring{{0.0, 0.0}, 0.5, 2.0}, Geometry::axisymmetric).area ==
        Approx(0.5 * measures(Ring{{0.0, 0.0}, 0.5, 2.0}, Geometry::plane_strain).area));
  // A circle that reaches over the axis a little, against midpoints.
  const Disk across{{0.7, 0.0}, 1.0};
  double area = 0.0, moment = 0.0;
  constexpr int count = 200000;
  for (int i = 0; i < count; ++i) {
    const double x = 1.7 * (i + 0.5) / count, height = 2.0 * std::sqrt(1.0 - (x - 0.7) * (x - 0.7));
    area += height * 1.7 / count, moment += x * height * 1.7 / count;
  }
  CHECK(measures(across, Geometry::axisymmetric).area == Approx(area).epsilon(1e-6));
  CHECK(measures(across, Geometry::axisymmetric).moment == Approx(moment).epsilon(1e-6));
}
