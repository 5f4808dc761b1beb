#include "catch.hpp"
#include "support/literal_damage.hpp"
#include "support/material_samples.hpp"
#include "support/random_states.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {
constexpr SymmetricTensor uniaxial{1.0, 0.0, 0.0, 0.0};
/// A segment of uniaxial strain at mean strain rate `rate`.
Segment stretch(double strain, double rate) {
  return {strain * uniaxial, std::abs(strain) / (3.0 * rate)};
}
double crack_density_of(double strain, double rate) {
  return literal_glass().coefficient(rate) * std::pow(strain / 3.0, 6.0);
}
}  // namespace

TEST_CASE("crack density follows eq. 7 at the running maximum of the rate", "[material][damage]") {
  const auto glass = composite_of(damaging_glass(), cell);
  const Driven slow = drive(*glass, {stretch(1.0e-4, 1.0e3)}, 1);
  CHECK(slow.state.max_rate == Approx(1.0e3).epsilon(1e-14));
  CHECK(slow.state.crack_density == Approx(crack_density_of(1.0e-4, 1.0e3)).epsilon(1e-13));

  SECTION("a fall of the rate is not forgotten") {
    const Driven then = drive(*glass, {stretch(0.2e-4, 10.0)}, 3, slow.state);
    CHECK(then.state.max_rate == slow.state.max_rate);
    CHECK(then.state.crack_density == Approx(crack_density_of(1.2e-4, 1.0e3)).epsilon(1e-12));
  }
  SECTION("a rise of the rate holds the crack density until eq. 7 catches up") {
    const Driven held = drive(*glass, {stretch(0.2e-4, 1.0e5)}, 4, slow.state);
    CHECK(held.state.crack_density == slow.state.crack_density);
    CHECK(held.dissipation.total() == 0.0);
    const Driven caught_up = drive(*glass, {stretch(4.0e-4, 1.0e5)}, 4, slow.state);
    CHECK(caught_up.state.crack_density == Approx(crack_density_of(5.0e-4, 1.0e5)).epsilon(1e-12));
  }
  SECTION("compression, however fast, does not count as a rate") {
    const Driven pressed = drive(*glass, {stretch(-3.0e-4, 1.0e6)}, 1, slow.state);
    CHECK(pressed.state.max_rate == slow.state.max_rate);
    const Driven back = drive(*glass, {stretch(1.0e-4, 1.0e6)}, 1, pressed.state);  // still under pressure
    CHECK(back.state.max_rate == slow.state.max_rate);
  }
  SECTION("a jump in time brings no rate") {
    const Driven jump = drive(*glass, {{0.1e-4 * uniaxial, 0.0}}, 1, slow.state);
    CHECK(jump.state.max_rate == slow.state.max_rate);
    CHECK(jump.state.crack_density == Approx(crack_density_of(1.1e-4, 1.0e3)).epsilon(1e-12));
  }
}

TEST_CASE("rate floor and fixed rate", "[material][damage]") {
  MaterialParameters p = damaging_glass();
  p.damage->rate_floor = 50.0;
  const Driven creeping = drive(*composite_of(p, cell), {stretch(0.3e-4, 1.0e-3)}, 2);
  CHECK(creeping.state.crack_density == Approx(crack_density_of(0.3e-4, 50.0)).epsilon(1e-12));
  p.damage->fixed_rate = 2.0e3;
  for (const double rate : {1.0, 1.0e5}) {
    const Driven fixed = drive(*composite_of(p, cell), {stretch(1.0e-4, rate)}, 2);
    CHECK(fixed.state.crack_density == Approx(crack_density_of(1.0e-4, 2.0e3)).epsilon(1e-12));
  }
}

TEST_CASE("unloading is secant with the crack density frozen", "[material][damage]") {
  const auto glass = composite_of(damaging_glass(), cell);
  Random random(3);
  for (int i = 0; i < 200; ++i) {
    SymmetricTensor e = random.direction();
    if (trace(e) < 0.3) continue;
    e *= 1.0e-3;
    const Driven loaded = drive(*glass, {{e, trace(e) / 3.0e3}}, 1);
    REQUIRE(loaded.state.crack_density > 0.0);
    const double share = random.uniform(0.1, 0.9);
    const Driven unloaded = drive(*glass, {{-share * e, 1e-7}}, 3, loaded.state);
    REQUIRE(unloaded.state.crack_density == loaded.state.crack_density);
    REQUIRE(distance(unloaded.state.stress, (1.0 - share) * loaded.state.stress) <
            1e-9 * norm(loaded.state.stress));
    REQUIRE(unloaded.dissipation.total() == 0.0);
    const Driven reloaded = drive(*glass, {{share * (1.0 - 1e-12) * e, 1e-3}}, 2, unloaded.state);
    REQUIRE(reloaded.state.crack_density == loaded.state.crack_density);
  }
}

TEST_CASE("closed cracks carry pressure but less shear", "[material][damage]") {
  const auto glass = composite_of(damaging_glass(), cell);
  const SymmetricTensor e{1.0e-3, 0.3e-3, -0.1e-3, 0.2e-3};
  const Driven loaded = drive(*glass, {{e, trace(e) / 3.0e3}}, 1);
  const SymmetricTensor compressed{-2.0e-4, -0.5e-4, 0.4e-4, 0.1e-4};
  const Driven pressed = drive(*glass, {{compressed - e, 1e-6}}, 1, loaded.state);
  const auto damaged = literal_glass().moduli(loaded.state.crack_density);
  CHECK(trace(pressed.state.stress) == Approx(3.0 * 48.0e9 * trace(compressed)).epsilon(1e-12));
  CHECK(distance(deviator(pressed.state.stress), 2.0 * damaged.shear * deviator(compressed)) < 1e-3);
  CHECK(damaged.shear < 0.99 * 28.8e9);

  SECTION("the stress is continuous where the mean strain changes sign") {
    const SymmetricTensor shear{1.0e-4, -0.6e-4, -0.4e-4, 0.3e-4};
    for (const double side : {-1e-14, 1e-14}) {
      CompositeState s = loaded.state;
      s.elastic_strain = shear + side * identity();
      const SymmetricTensor stress = glass->secant_moduli(s).stress(s.elastic_strain);
      CHECK(distance(stress, 2.0 * damaged.shear * shear) < 1e-13 * 3.0 * 48.0e9 * 10.0);
    }
  }
}

TEST_CASE("damage is frozen after localisation", "[material][damage][decohesion]") {
  const auto glass = composite_of(fracturing_glass(), cell);
  const Driven at = drive(*glass, {stretch(1.48e-4 * 10.0, 1.0e6)}, 1);  // 1.471e-4 at 1 /s
  REQUIRE_FALSE(is_localised(at.state));
  const Driven past = drive(*glass, {stretch(3.0e-2, 1.0e6)}, 1);
  REQUIRE(is_localised(past.state));
  CHECK(past.state.crack_density == Approx(0.118315 * crack_density_limit).epsilon(1e-5));
  const Driven later =
      drive(*glass, {{{-2.0e-2, 1.0e-2, 4.0e-2, 1.0e-2}, 1e-7}, stretch(0.1, 1.0e5)}, 7, past.state);
  CHECK(later.state.crack_density == past.state.crack_density);
  CHECK(later.dissipation.damage == 0.0);
}

TEST_CASE("work = stored energy + dissipation of growing damage", "[material][damage]") {
  MaterialParameters of_metal = damaging_glass(), of_sand = damaging_glass();
  of_metal.von_mises = VonMisesParameters{1e12, 1e12, 0.0, 0.0};
  of_sand.drucker_prager = DruckerPragerParameters{1e12, 1.8, false};
  const auto glass = composite_of(GENERATE_REF(damaging_glass(), of_metal, of_sand),
                                  cell);  // yield surfaces that nothing reaches
  Random random(4);
  for (int i = 0; i < 20; ++i) {
    std::vector<Segment> path;
    for (int k = 0; k < 4; ++k) {
      SymmetricTensor e = random.tensor(4.0e-4);
      e += random.uniform(-0.5e-4, 2.0e-4) * identity();
      path.push_back({e, random.logarithmic(1e-7, 1e-5)});
    }
    const Driven fine = drive(*glass, path, 4000);
    const double balance = fine.work - glass->stored_energy(fine.state) - fine.dissipation.total();
    CAPTURE(i);
    REQUIRE(std::abs(balance) < 1e-5 * (fine.dissipation.total() + glass->stored_energy(fine.state)));
    REQUIRE(fine.least_dissipation >= 0.0);
    const Driven coarse = drive(*glass, path, 1);
    REQUIRE(coarse.dissipation.total() == Approx(fine.dissipation.total()).epsilon(2e-4).margin(1e-9));
  }
}

TEST_CASE("damage that a first load has paid for is not booked again by a second, flowing or not",
          "[material][damage][energy]") {
  // A step of the second load begins far inside the damage of the first: nothing is set free up to there.
  const double first = 1.4e-3, second = 1.8e-3, rate = 1.0e3;
  const std::vector<Segment> path{stretch(first, rate), stretch(-first, rate), stretch(second, rate)};
  for (const double yield : {1e12, 40.0e6}) {
    MaterialParameters p = damaging_glass();
    p.von_mises = VonMisesParameters{yield, yield, 0.0, 0.0};
    const auto material = composite_of(p, cell);
    const Driven fine = drive(*material, path, 4000);
    const bool flows = fine.dissipation.plastic > 0.0;
    CHECK(flows == (yield < 1e12));
    for (const int steps : {1, 2, 5}) {
      CAPTURE(yield, steps);
      CHECK(drive(*material, path, steps).dissipation.damage ==
            Approx(fine.dissipation.damage).epsilon(flows ? 0.02 : 1e-5));
    }
  }
}

TEST_CASE("an initial tension is damaged at once, and the energy is booked", "[material][damage][energy]") {
  const auto glass = composite_of(damaging_glass(), cell);
  for (const double stress : {3.0e6, 5.0e6, 50.0e6}) {
    const CompositeState start = glass->initial_state(stress * identity());
    CompositeState s = start;
    PointReport report;
    glass->judge(s, report);
    CAPTURE(stress);
    const double target = literal_glass().coefficient(1.0) * std::pow(stress / (3.0 * 48.0e9), 6.0);
    CHECK(s.crack_density == Approx(std::min(9.0 / 16.0, target)).epsilon(1e-6));
    CHECK(report.dissipation.damage ==
          Approx(glass->stored_energy(start) - glass->stored_energy(s)).epsilon(1e-6));
  }
}
