#include "mpm/boundary.hpp"

#include <cmath>
#include <limits>

#include "catch.hpp"
#include "support/random_states.hpp"

using vitrum::mpm::Boundary;
using namespace vitrum::test;

TEST_CASE("A moving box is always within half a cell of its place, and tells when it goes on", "[mpm]") {
  Random random(3);
  for (int n = 0; n < 2000; ++n) {
    const double cell = random.logarithmic(1e-5, 1.0), speed = random.logarithmic(1e-3, 1e4),
                 since = random.uniform(-1e-3, 1e-3);
    Boundary box{"", {0.0, 0.0}, {1.0, 1.0}, {true, true}, {speed, random.chance(0.5) ? -2.0 * speed : 0.0}};
    box.since = since;
    double t = since + random.uniform(0.0, 5.0) * cell / speed;
    CAPTURE(cell, speed, since, t);
    for (int k = 0; k < 5; ++k) {
      for (std::size_t c = 0; c < 2; ++c)
        CHECK(std::abs(box.shift(c, t, cell) - box.velocity[c] * (t - since) / cell) < 0.5 + 1e-6);
      const double next = box.next_shift(t, cell), before = std::nextafter(next, t);
      REQUIRE(next > t);
      CHECK(box.shift(0, before, cell) == box.shift(0, t, cell));
      CHECK(box.shift(1, before, cell) == box.shift(1, t, cell));
      CHECK((box.shift(0, next, cell) != box.shift(0, t, cell) ||
             box.shift(1, next, cell) != box.shift(1, t, cell)));
      t = next;
    }
  }
}

TEST_CASE("A box that stays, or has no velocity, never goes on", "[mpm]") {
  Boundary box{"", {0.0, 0.0}, {1.0, 1.0}, {true, true}, {1.0, 0.0}, false};
  CHECK(box.shift(0, 1e3, 0.1) == 0.0);
  CHECK(std::isinf(box.next_shift(0.0, 0.1)));
  box.moves = true, box.velocity[0] = 0.0;
  CHECK(box.shift(0, 1e3, 0.1) == 0.0);
  CHECK(std::isinf(box.next_shift(0.0, 0.1)));
  box.velocity[0] = std::numeric_limits<double>::max();
  CHECK(std::isfinite(box.shift(0, 1.0, 1e-3)));
}
