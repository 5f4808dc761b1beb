#include "scene/seeding.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "scene/shape_measures.hpp"
#include "scene/shapes.hpp"
#include "tests/catch.hpp"

using namespace vitrum;

namespace {

/// A star about the origin, whose rows enter and leave it many times.
Polygon star(std::mt19937& random, int corners) {
  std::uniform_real_distribution<double> radius(0.1, 1.0);
  Polygon p;
  for (int k = 0; k < corners; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / corners, r = radius(random);
    p.vertices.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return p;
}

}  // namespace

TEST_CASE("Rows of particles fill a polygon as the even-odd rule does point by point", "[scene]") {
  std::mt19937 random(7);
  for (const int corners : {3, 4, 5, 12, 60}) {
    for (int repeat = 0; repeat < 20; ++repeat) {
      const Polygon polygon = star(random, corners);
      constexpr double spacing = 0.03125;  // vertices on lattice lines and points included
      std::vector<Vector2> expected;
      for (int j = -40; j < 40; ++j)
        for (int i = -40; i < 40; ++i)
          if (const Vector2 x{(i + 0.5) * spacing, (j + 0.5) * spacing}; contains(Shape(polygon), x))
            expected.push_back(x);
      std::vector<Vector2> found;
      for (const Seed& seed : seed_shape(polygon, spacing, 1)) found.push_back(seed.position);
      CHECK(found == expected);
    }
  }
  const Polygon square{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}};
  CHECK(seed_shape(square, 0.25, 1).size() == 16);
}

TEST_CASE("Areas of shapes tell how many particles they hold", "[scene]") {
  std::mt19937 random(11);
  const std::vector<Shape> shapes{Box{{0.0, 1.0}, {3.0, 2.0}}, Disk{{4.0, 0.0}, 1.5},
                                  Ring{{0.0, 0.0}, 0.5, 2.0}, star(random, 9)};
  for (const Shape& shape : shapes) {
    const double cell = 0.01;
    const double count = measures(shape, Geometry::plane_strain).area / (cell * cell);
    CHECK(static_cast<double>(seed_shape(shape, cell, 1).size()) == Approx(count).epsilon(0.01));
    CHECK(static_cast<double>(seed_shape(shape, cell, 1).size()) <= most_seeds(shape, cell, 1));
  }
  CHECK(measures(shapes[2], Geometry::axisymmetric).area ==
        Approx(0.5 * measures(shapes[2], Geometry::plane_strain).area));
}
