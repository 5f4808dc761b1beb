#include <algorithm>
#include <numbers>

#include "mpm/contact/pair_law.hpp"
#include "mpm/contact/pairs.hpp"
#include "support/random_states.hpp"
#include "tests/catch.hpp"

using namespace vitrum::mpm;
using vitrum::test::Random;

namespace {

PlacedPatch random_patch(Random& random, double angle) {
  return {{random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4)},
          {},
          angle + random.uniform(-1.0, 1.0),
          random.uniform(0.5, 1.5),
          random.uniform(0.5, 2.0),
          random.uniform(0.0, 1.0) < 0.3 ? 0.0 : random.uniform(0.0, 2.0)};
}

constexpr PairStiffness law{3.0, 0.3};

}  // namespace

TEST_CASE("Forces and couples of a pair are the derivatives of its energy, and make no momentum",
          "[contact]") {
  Random random(11);
  int touching = 0;
  for (int n = 0; n < 4000; ++n) {
    const PlacedPatch a = random_patch(random, 0.3), b = random_patch(random, 0.3 + std::numbers::pi);
    const PairForce f = pair_force(a, b, law);
    if (f.energy == 0.0) continue;
    ++touching;
    constexpr double step = 1e-6;
    const auto slope = [&](auto&& move_by) {
      PlacedPatch low_a = a, low_b = b, high_a = a, high_b = b;
      move_by(low_a, low_b, -step), move_by(high_a, high_b, step);
      return (pair_force(high_a, high_b, law).energy - pair_force(low_a, low_b, law).energy) / (2.0 * step);
    };
    constexpr double margin = 1e-5;
    for (std::size_t c = 0; c < 2; ++c) {
      CHECK(-f.force[c] ==
            Approx(slope([c](auto&, auto& to, double by) { to.place[c] += by; })).margin(margin));
      CHECK(f.force[c] ==
            Approx(slope([c](auto& to, auto&, double by) { to.place[c] += by; })).margin(margin));
    }
    CHECK(-f.couple_a == Approx(slope([](auto& to, auto&, double by) { to.angle += by; })).margin(margin));
    CHECK(-f.couple_b == Approx(slope([](auto&, auto& to, double by) { to.angle += by; })).margin(margin));
    const Vector arm{b.place[0] - a.place[0], b.place[1] - a.place[1]};
    CHECK(f.couple_a + f.couple_b + cross(arm, f.force) == Approx(0.0).margin(1e-14));
    CHECK(f.pressure >= 0.0);
    CHECK(f.overlap > 0.0);
    CHECK(f.overlap <= 1.0);
  }
  CHECK(touching > 500);
}

TEST_CASE("Particles that cracks have laid open push each other apart, by the derivative of their energy",
          "[contact]") {
  Random random(17);
  for (int n = 0; n < 500; ++n) {
    const Vector a{random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4)},
        b{random.uniform(-0.4, 0.4), random.uniform(-0.4, 0.4)};
    const PairForce f = pair_force(a, b, 0.8, 0.5, law);
    for (std::size_t c = 0; c < 2; ++c) {
      constexpr double step = 1e-6;
      Vector low = b, high = b;
      low[c] -= step, high[c] += step;
      CHECK(-f.force[c] ==
            Approx((pair_force(a, high, 0.8, 0.5, law).energy - pair_force(a, low, 0.8, 0.5, law).energy) /
                   (2.0 * step))
                .margin(1e-5));
    }
  }
  CHECK(pair_force({0.0, 0.0}, {0.81, 0.0}, 0.8, 0.5, law).energy == 0.0);
}

TEST_CASE("Forces of a pair change by no more than a bound times what patches are moved by", "[contact]") {
  Random random(5);
  for (int n = 0; n < 20000; ++n) {
    const PlacedPatch a = random_patch(random, 0.0);
    PlacedPatch b = random_patch(random, std::numbers::pi);
    const PairForce before = pair_force(a, b, law);
    constexpr double by = 1e-4;
    b.place[0] += random.uniform(-by, by), b.place[1] += random.uniform(-by, by);
    b.angle += random.uniform(-by, by);
    const PairForce after = pair_force(a, b, law);
    CHECK(std::hypot(after.force[0] - before.force[0], after.force[1] - before.force[1]) < 60.0 * by);
    CHECK(std::abs(after.couple_b - before.couple_b) < 60.0 * by);
  }
}

TEST_CASE("A row of patches feels the same pressure wherever those of the other body lie", "[contact]") {
  // The other's may be shorter by a whole number: the shares of opposite patches add up to one.
  for (const int parts : {1, 2, 3})
    for (double offset = 0.0; offset < 1.0; offset += 0.13) {
      const PlacedPatch a{{0.0, 0.0}, {}, 0.5 * std::numbers::pi, 1.0, 1.0};
      double force = 0.0, along = 0.0;
      for (int k = -3 * parts; k <= 3 * parts; ++k) {
        const PlacedPatch b{{(k + offset) / parts, -0.1}, {}, -0.5 * std::numbers::pi, 1.0 / parts, 1.0};
        const PairForce f = pair_force(a, b, law);
        force -= f.force[1], along += f.force[0];
      }
      CHECK(force == Approx(-law.stiffness * 0.1).epsilon(1e-12));
      CHECK(along == Approx(0.0).margin(1e-12));
    }
}

TEST_CASE("What is round or sharp is pushed along the normal of the plane that it meets", "[contact]") {
  // A row of patches, and one of a sharper surface over it, anywhere and at any slope.
  Random random(29);
  for (int n = 0; n < 1000; ++n) {
    const PlacedPatch one{{random.uniform(0.0, 1.0), random.uniform(-0.25, -0.02)},
                          {},
                          -0.5 * std::numbers::pi + random.uniform(-0.9, 0.9),
                          1.0,
                          1.0,
                          random.uniform(0.01, 3.0)};
    double energy = 0.0, down = 0.0, along = 0.0;
    for (int k = -3; k <= 4; ++k) {
      const PlacedPatch flat{{static_cast<double>(k), 0.0}, {}, 0.5 * std::numbers::pi, 1.0, 1.0, 0.0};
      const PairForce f = pair_force(flat, one, law);
      energy += f.energy, down += f.pressure, along += f.force[0];
    }
    CHECK(std::abs(along) < 1e-13);
    // The pressure is that of its depth, whatever its slope.
    const double facing =
        pair_force({one.place, {}, 0.5 * std::numbers::pi, 1.0, 1.0, 0.0}, one, law).overlap;
    CHECK(
        down ==
        Approx(facing * law.stiffness * law.depth * Barrier(-one.place[1] / law.depth).slope).margin(1e-13));
    CHECK(energy > 0.0);
  }
}

TEST_CASE("Circles meet along the line through their centres", "[contact]") {
  Random random(31);
  for (int n = 0; n < 1000; ++n) {
    const double ra = random.uniform(2.0, 50.0), rb = random.uniform(2.0, 50.0),
                 along = random.uniform(-0.5, 0.5);
    // The places of both that lie opposite each other, along the line x = 0 of centres.
    const double of_a = std::asin(along / ra), of_b = -0.5 * std::numbers::pi + std::asin(along / rb);
    const PlacedPatch a{
        {along, ra * (std::cos(of_a) - 1.0)}, {}, 0.5 * std::numbers::pi - of_a, 1.0, 1.0, 1.0 / ra},
        b{{along, rb * (1.0 + std::sin(of_b)) - 0.1}, {}, of_b, 1.0, 1.0, 1.0 / rb};
    const PairForce f = pair_force(a, b, law);
    CHECK(std::abs(f.normal[0]) < 1e-14);
    CHECK(f.normal[1] == Approx(1.0));
  }
}

TEST_CASE("The search finds the pairs that are near, in their order", "[contact]") {
  Random random(3);
  PairSearch search;
  for (int n = 0; n < 40; ++n) {
    const auto places = [&](std::size_t count, double from) {
      std::vector<Vector> list(count);
      for (Vector& place : list)
        place = {from + random.uniform(0.0, 3.0), random.uniform(0.0, n % 2 == 0 ? 1.0 : 9.0)};
      return list;
    };
    const std::vector<Vector> a = places(60, 0.0), b = places(80, random.uniform(-4.0, 4.0));
    constexpr double reach = 0.4;
    std::vector<std::array<std::size_t, 2>> near, found;
    for (std::size_t i = 0; i < a.size(); ++i)
      for (std::size_t j = 0; j < b.size(); ++j)
        if (std::abs(a[i][0] - b[j][0]) <= reach && std::abs(a[i][1] - b[j][1]) <= reach)
          near.push_back({i, j});
    search.find(a, b, reach, [&](std::uint32_t i, std::uint32_t j) { found.push_back({i, j}); });
    CHECK(found == near);
  }
}
