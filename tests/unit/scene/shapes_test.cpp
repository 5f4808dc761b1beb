#include "scene/shapes.hpp"

#include <cmath>

#include "catch.hpp"
#include "scene/read_scene.hpp"
#include "support/mpm_scene.hpp"
#include "support/random_states.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

constexpr double resolution = 0.05, tolerance = 1e-7;

Shape random_shape(Random& random) {
  const Vector2 at{random.uniform(0.0, 4.0), random.uniform(0.0, 4.0)};
  const double size = random.uniform(0.2, 1.5);
  switch (static_cast<int>(random.uniform(0.0, 4.0))) {
    case 0:
      return Box{at, {at[0] + size, at[1] + random.uniform(0.2, 1.5)}};
    case 1:
      return Disk{at, size};
    case 2:
      return Ring{at, 0.5 * size, size};
    default:
      return Polygon{{at, {at[0] + size, at[1]}, {at[0] + 0.3 * size, at[1] + size}}};
  }
}

/// How many of 20,000 random points of an area of 64 lie in both.
std::size_t points_in_both(const Shape& a, const Shape& b, Random& random) {
  std::size_t count = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vector2 x{random.uniform(-2.0, 6.0), random.uniform(-2.0, 6.0)};
    count += contains(a, x) && contains(b, x) ? 1U : 0U;
  }
  return count;
}

}  // namespace

TEST_CASE("a common point lies in both shapes, and is found wherever random points find one", "[scene]") {
  Random random(71);
  int overlapping = 0;
  for (int i = 0; i < 300; ++i) {
    const Shape a = random_shape(random), b = random_shape(random);
    const auto found = common_point(a, b, resolution, tolerance);
    const std::size_t hits = points_in_both(a, b, random);
    CAPTURE(i, a.index(), b.index(), hits);
    if (found) {
      ++overlapping;
      REQUIRE(contains(a, *found));
      REQUIRE(contains(b, *found));
    } else {
      REQUIRE(hits <= 5);  // of 312 a unit area: less than a few squares of the lattice
    }
    REQUIRE(common_point(b, a, resolution, tolerance).has_value() == found.has_value());
  }
  CHECK(overlapping > 30);
  CHECK(overlapping < 270);
}

TEST_CASE("shapes that touch have no point in common", "[scene]") {
  const Shape box = Box{{0.1, 0.3}, {0.7, 0.9}};
  const Shape touching[] = {Box{{0.7, 0.0}, {1.0, 1.0}}, Box{{0.0, 0.9}, {1.0, 1.0}},
                            Box{{0.7, 0.9}, {1.0, 1.0}}, Disk{{0.4, 1.4}, 0.5},
                            Polygon{{{0.7, 0.3}, {1.0, 0.6}, {0.7, 0.9}}}};
  for (const Shape& other : touching) {
    CAPTURE(other.index());
    CHECK_FALSE(common_point(box, other, resolution, tolerance));
  }
  CHECK_FALSE(common_point(Disk{{0.4, 0.4}, 0.2}, Ring{{0.4, 0.4}, 0.2, 0.3}, resolution, tolerance));
  // Two halves of a square along its diagonal.
  CHECK_FALSE(common_point(Polygon{{{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}}},
                           Polygon{{{0.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}}, resolution, tolerance));
  // A hundred times the tolerance is an overlap, however thin.
  CHECK(common_point(box, Box{{0.7 - 100 * tolerance, 0.0}, {1.0, 1.0}}, resolution, tolerance));
  // A lattice of astronomical size is thinned.
  CHECK(common_point(Box{{0.0, 0.0}, {1e9, 1e9}}, Box{{5e8, 5e8}, {2e9, 2e9}}, 1e-9, 1e-15));
}

TEST_CASE("overlapping bodies are refused with both names and the place; touching ones are not", "[scene]") {
  MpmScene scene;
  const auto with_ball_at = [&](double y, double radius) {
    scene.tables = body("block", box({0.0, 0.0}, {6.0, 3.0})) + body("ball", disk({3.0, y}, radius));
    return scene.text();
  };
  CHECK_NOTHROW(parse_scene(with_ball_at(5.0, 2.0), "s.toml"));
  try {
    parse_scene(with_ball_at(4.5, 2.0), "s.toml");
    FAIL("no error");
  } catch (const InputError& error) {
    const std::string text = error.what();
    CAPTURE(text);
    CHECK(text.find("s.toml:") == 0);
    CHECK(text.find("key 'body.1.disk': found it overlapping body 'block' at (") != std::string::npos);
    CHECK(text.find("expected bodies that at most touch") != std::string::npos);
  }
}
