// Shapes put together and cut out: their edges, areas, particles and gaps.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/seeding.hpp"
#include "scene/shape_gap.hpp"
#include "scene/shape_measures.hpp"
#include "scene/shapes.hpp"
#include "scene/surface_edges.hpp"
#include "support/random_states.hpp"
#include "support/region_measures.hpp"
#include "tests/catch.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

constexpr double pi = std::numbers::pi;

Shape random_shape(Random& random, double width = 5.0) {
  const Vector2 at{random.uniform(4.0, 4.0 + width), random.uniform(0.0, width)};
  const double size = random.uniform(0.5, 3.0);
  switch (random.integer(0, 3)) {
    case 0:
      return Box{at, {at[0] + size, at[1] + random.uniform(0.5, 3.0)}};
    case 1:
      return Disk{at, size};
    case 2:
      return Ring{at, 0.5 * size, size};
    default:
      return Polygon{{at, {at[0] + 0.3 * size, at[1] + size}, {at[0] + size, at[1]}}};
  }
}
/// Of up to three shapes that overlap or not, with up to two holes.
Region random_region(Random& random) {
  Union together;
  for (int n = random.integer(1, 3); n > 0; --n) {
    together.parts.emplace_back(random_shape(random));
    if (random.chance(0.3)) together.parts.back().holes.emplace_back(random_shape(random));
  }
  Region region(together);
  for (int n = random.integer(0, 2); n > 0; --n) region.holes.emplace_back(random_shape(random));
  return region;
}

/// Whether a region lies on one side of an edge alone, there.
bool separates(const Region& region, const Edge& edge, double s) {
  const Vector2 x = edge.place(s);
  const double angle = edge.normal(s);
  const Vector2 step{1e-6 * std::cos(angle), 1e-6 * std::sin(angle)};
  return contains(region, {x[0] - step[0], x[1] - step[1]}) !=
         contains(region, {x[0] + step[0], x[1] + step[1]});
}
/// How much of its shapes' edges lies between inside and outside, by points along them.
double length_between(const Region& region, const std::vector<Region>& parts,
                      const std::vector<Region>& holes) {
  constexpr int count = 100;
  double length = 0.0;
  for (const auto* shapes : {&parts, &holes})
    for (const Region& shape : *shapes)
      for (const Edge& edge : edges_of(shape, false))
        for (int k = 0; k < count; ++k)
          if (separates(region, edge, (k + 0.5) / count)) length += edge.length() / count;
  return length;
}
void check_that_edges_separate(const Region& region) {
  for (const Edge& edge : edges_of(region, false)) {
    if (edge.length() < 1e-3) continue;
    const Vector2 x = edge.place(0.5);
    const double angle = edge.normal(0.5);
    CHECK(contains(region, {x[0] - 1e-6 * std::cos(angle), x[1] - 1e-6 * std::sin(angle)}));
    CHECK(!contains(region, {x[0] + 1e-6 * std::cos(angle), x[1] + 1e-6 * std::sin(angle)}));
  }
}

}  // namespace

TEST_CASE("regions have the area of their points, a closed edge, and particles of that very mass",
          "[scene]") {
  Random random(31);
  for (int number = 0; number < 150; ++number) {
    const Region region = random_region(random);
    const ShapeMeasures exact = measures(region, Geometry::plane_strain);
    const auto [area, moment] = by_points(region);
    CAPTURE(number, area, exact.area);
    CHECK(exact.area == Approx(area).margin(0.02));
    CHECK(exact.moment == Approx(moment).margin(0.2));
    const auto open = open_ends(edges_of(region, false));
    CHECK(std::abs(open[0]) + std::abs(open[1]) < 1e-3);
    for (const int per_side : {1, 3}) {
      const auto seeds = seed_shape(region, 0.7, per_side, Geometry::plane_strain);
      if (seeds.empty()) {
        CHECK(exact.area < 0.25 * 0.49 / (per_side * per_side) + 1e-12);
        continue;
      }
      CHECK(sums(seeds)[0] == Approx(exact.area).epsilon(1e-7));
      CHECK(sums(seeds)[1] == Approx(exact.moment).epsilon(1e-7));
      CHECK(static_cast<double>(seeds.size()) <= most_seeds(region, 0.7, per_side));
    }
  }
}

TEST_CASE("every edge of a region separates inside from outside", "[scene]") {
  Random random(32);
  for (int number = 0; number < 100; ++number) {
    const Region region = random_region(random);
    CAPTURE(number);
    check_that_edges_separate(region);
  }
}

TEST_CASE("of many shapes what lies between inside and outside is the edge, in whichever order they are told",
          "[scene]") {
  Random random(35);
  for (int number = 0; number < 4; ++number) {
    std::vector<Region> parts, holes;
    for (int n = 0; n < 40; ++n) parts.emplace_back(random_shape(random, 25.0));
    for (int n = 0; n < 40; ++n) holes.emplace_back(random_shape(random, 25.0));
    const auto region = [&] { return without(Region(Union{parts}), holes); };
    const ShapeMeasures found = measures(region(), Geometry::plane_strain);
    CAPTURE(number);
    check_that_edges_separate(region());
    CHECK(found.perimeter == Approx(length_between(region(), parts, holes)).epsilon(0.01));
    CHECK(found.area == Approx(by_points(region())[0]).epsilon(0.003));
    std::ranges::reverse(parts);
    std::ranges::reverse(holes);
    const ShapeMeasures again = measures(region(), Geometry::plane_strain);
    CHECK(again.perimeter == Approx(found.perimeter).epsilon(1e-12));
    CHECK(again.area == Approx(found.area).epsilon(1e-12));
  }
}

TEST_CASE("shapes that share edges, touch or coincide are put together as they should", "[scene]") {
  const auto area = [](const Region& r) { return measures(r, Geometry::plane_strain).area; };
  const auto perimeter = [](const Region& r) { return measures(r, Geometry::plane_strain).perimeter; };
  const auto together = [](std::vector<Region> parts) { return Region(Union{std::move(parts)}); };
  const Box left{{0.1, 0.0}, {1.1, 1.0}}, right{{1.1, 0.0}, {2.3, 1.0}}, tall{{1.1, -1.0}, {2.1, 2.0}};
  CHECK(area(together({left, right})) == Approx(2.2));
  CHECK(perimeter(together({left, right})) == Approx(6.4));
  CHECK(area(together({left, left})) == Approx(1.0));
  CHECK(perimeter(together({left, left})) == Approx(4.0));
  CHECK(area(together({left, tall})) == Approx(4.0));
  CHECK(perimeter(together({left, tall})) == Approx(10.0));
  CHECK(area(without(left, {right})) == Approx(1.0));
  CHECK(perimeter(without(left, {right})) == Approx(4.0));
  CHECK(area(without(left, {left})) == Approx(0.0).margin(1e-14));
  CHECK(edges_of(without(left, {left}), false).empty());
  // A disk that fills a ring's hole; a hole that touches the edge in a point; a disk that touches from
  // outside.
  const Vector2 o{0.3, 0.2};
  CHECK(area(together({Ring{o, 0.7, 1.3}, Disk{o, 0.7}})) == Approx(pi * 1.69));
  CHECK(perimeter(together({Ring{o, 0.7, 1.3}, Disk{o, 0.7}})) == Approx(2.0 * pi * 1.3));
  CHECK(area(without(Disk{o, 1.3}, {Disk{o, 0.7}})) == Approx(pi * (1.69 - 0.49)));
  CHECK(area(without(left, {Disk{{0.6, 0.25}, 0.25}})) == Approx(1.0 - pi / 16.0));
  CHECK(area(together({left, Disk{{0.6, 1.25}, 0.25}})) == Approx(1.0 + pi / 16.0));
  // Half of a disk by a box whose side passes through its centre.
  CHECK(area(without(Disk{o, 1.3}, {Box{{0.3, -5.0}, {5.0, 5.0}}})) == Approx(0.5 * pi * 1.69));
  CHECK(perimeter(without(Disk{o, 1.3}, {Box{{0.3, -5.0}, {5.0, 5.0}}})) == Approx(1.3 * (pi + 2.0)));
}

TEST_CASE("edges of holes are inner, where a hole is closed", "[scene]") {
  const auto inner = [](const Region& region) {
    double length = 0.0;
    for (const Edge& edge : edges_of(region, false)) length += edge.inner() ? edge.length() : 0.0;
    return length;
  };
  const Box slab{{0.0, 0.0}, {4.0, 2.0}};
  CHECK(inner(slab) == 0.0);
  CHECK(inner(without(slab, {Disk{{1.0, 1.0}, 0.5}, Box{{2.0, 0.5}, {3.0, 1.5}}})) == Approx(pi + 4.0));
  CHECK(inner(without(slab, {Disk{{1.0, 2.0}, 0.5}})) == 0.0);  // a notch
  CHECK(inner(Ring{{0.0, 0.0}, 1.0, 2.0}) == Approx(2.0 * pi));
  // Four bars round a window.
  CHECK(inner(Region(Union{{Box{{0.0, 0.0}, {3.0, 1.0}}, Box{{0.0, 2.0}, {3.0, 3.0}},
                            Box{{0.0, 0.5}, {1.0, 2.5}}, Box{{2.0, 0.5}, {3.0, 2.5}}}})) == Approx(4.0));
}

TEST_CASE("of a region about the axis the half beyond it is meant", "[scene]") {
  const Region shell = without(Disk{{0.0, 3.0}, 2.0}, {Disk{{0.0, 3.0}, 1.0}});
  const Region ring(Ring{{0.0, 3.0}, 1.0, 2.0});
  const ShapeMeasures found = measures(shell, Geometry::axisymmetric),
                      expected = measures(ring, Geometry::axisymmetric);
  CHECK(found.area == Approx(expected.area));
  CHECK(found.moment == Approx(expected.moment));
  CHECK(found.perimeter == Approx(expected.perimeter));
  double inner = 0.0;
  for (const Edge& edge : edges_of(shell, true)) inner += edge.inner() ? edge.length() : 0.0;
  CHECK(inner == Approx(pi));
  CHECK(sums(seed_shape(shell, 0.3, 2, Geometry::axisymmetric))[1] == Approx(expected.moment).epsilon(1e-7));
}

TEST_CASE("the gap to a hole is that to its edge", "[scene]") {
  const Region plate = without(Box{{0.0, 0.0}, {10.0, 10.0}}, {Box{{2.0, 2.0}, {8.0, 8.0}}});
  CHECK(gap(plate, Disk{{5.0, 5.0}, 2.5}) == Approx(0.5));
  CHECK(gap(plate, Disk{{12.0, 12.0}, 1.0}) == Approx(std::sqrt(8.0) - 1.0));
  const Region moon = without(Disk{{0.0, 0.0}, 2.0}, {Disk{{1.5, 0.0}, 2.0}});
  CHECK(gap(moon, Disk{{1.5, 0.0}, 1.0}) == Approx(1.0));
  CHECK(gap(moon, Disk{{-4.0, 0.0}, 1.0}) == Approx(1.0));
  CHECK(!common_point(plate, Disk{{5.0, 5.0}, 2.5}, 0.1, 1e-6));
  CHECK(common_point(plate, Disk{{5.0, 5.0}, 3.5}, 0.1, 1e-6));
}
