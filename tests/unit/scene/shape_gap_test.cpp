#include "scene/shape_gap.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "scene/shapes.hpp"
#include "support/random_states.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

Shape random_shape(Random& random) {
  const Vector2 at{random.uniform(0.0, 6.0), random.uniform(0.0, 6.0)};
  const double size = random.uniform(0.2, 1.5);
  switch (random.integer(0, 3)) {
    case 0:
      return Box{at, {at[0] + size, at[1] + random.uniform(0.2, 1.5)}};
    case 1:
      return Disk{at, size};
    case 2:
      return Ring{at, 0.6 * size, size};
    default:
      return Polygon{{at, {at[0] + size, at[1] + 0.2}, {at[0] + 0.3 * size, at[1] + size}}};
  }
}

/// Points along a shape's edge.
std::vector<Vector2> edge_points(const Shape& shape) {
  constexpr int count = 400;
  std::vector<Vector2> points;
  const auto circle = [&](const Vector2& c, double r) {
    for (int i = 0; i < count; ++i) {
      const double angle = 2.0 * std::numbers::pi * i / count;
      points.push_back({c[0] + r * std::cos(angle), c[1] + r * std::sin(angle)});
    }
  };
  const auto polygon = [&](const std::vector<Vector2>& v) {
    for (std::size_t i = 0, j = v.size() - 1; i < v.size(); j = i++)
      for (int k = 0; k < count; ++k)
        points.push_back({std::lerp(v[j][0], v[i][0], static_cast<double>(k) / count),
                          std::lerp(v[j][1], v[i][1], static_cast<double>(k) / count)});
  };
  if (const auto* b = std::get_if<Box>(&shape))
    polygon({b->min, {b->max[0], b->min[1]}, b->max, {b->min[0], b->max[1]}});
  if (const auto* d = std::get_if<Disk>(&shape)) circle(d->centre, d->radius);
  if (const auto* r = std::get_if<Ring>(&shape)) circle(r->centre, r->inner), circle(r->centre, r->outer);
  if (const auto* p = std::get_if<Polygon>(&shape)) polygon(p->vertices);
  return points;
}

}  // namespace

TEST_CASE("the gap between shapes is that of their nearest points", "[scene]") {
  Random random(23);
  int apart = 0;
  for (int i = 0; i < 150; ++i) {
    const Shape a = random_shape(random), b = random_shape(random);
    if (common_point(a, b, 0.02, 1e-7)) continue;
    double sampled = 1e300;
    const std::vector<Vector2> of_a = edge_points(a), of_b = edge_points(b);
    for (const Vector2& x : of_a)
      for (const Vector2& y : of_b) sampled = std::min(sampled, std::hypot(x[0] - y[0], x[1] - y[1]));
    CAPTURE(i, a.index(), b.index());
    CHECK(gap(a, b) <= sampled + 1e-12);
    CHECK(gap(a, b) >= sampled - 0.03);  // as far as points along the edges are apart
    CHECK(gap(a, b) == Approx(gap(b, a)).margin(1e-14));
    ++apart;
  }
  CHECK(apart > 80);
  CHECK(gap(Box{{0.0, 0.0}, {1.0, 1.0}}, Box{{1.0, 0.2}, {2.0, 0.8}}) == 0.0);
  CHECK(gap(Disk{{0.0, 0.0}, 1.0}, Disk{{3.0, 4.0}, 2.5}) == Approx(1.5));
  CHECK(gap(Disk{{0.5, 0.0}, 1.0}, Ring{{0.0, 0.0}, 2.0, 3.0}) == Approx(0.5));  // in the hole
  CHECK(gap(Box{{0.0, 0.0}, {1.0, 1.0}}, Disk{{4.0, 5.0}, 3.0}) == Approx(2.0));
}
