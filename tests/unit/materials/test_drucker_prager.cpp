#include "catch.hpp"
#include "support/material_samples.hpp"
#include "support/random_states.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

constexpr double K = 48.0e9, G = 28.8e9, yield = 43.0e6, beta = 1.8;

MaterialParameters crushable_glass(bool associated) {
  MaterialParameters p = bare_glass();
  p.drucker_prager = glass_drucker_prager();
  p.drucker_prager->associated = associated;
  return p;
}
double pressure(const SymmetricTensor& stress) {
  return -trace(stress) / 3.0;
}
double effective_stress(const SymmetricTensor& stress) {
  const SymmetricTensor s = deviator(stress);
  return std::sqrt(1.5 * contract(s, s));
}
double yield_function(const SymmetricTensor& stress) {
  return effective_stress(stress) - yield - beta * pressure(stress);
}

}  // namespace

TEST_CASE("Drucker-Prager returns to the surface to 1e-12 and obeys its flow rule",
          "[material][drucker_prager]") {
  Random random(40);
  for (const bool associated : {false, true}) {
    const auto glass = composite_of(crushable_glass(associated), cell);
    int flowed = 0;
    for (int i = 0; i < 5000; ++i) {
      const SymmetricTensor strain = random.uniform(1e-3, 1e-2) * random.deviatoric_direction() -
                                     random.uniform(1e-6, 1e-3) * identity();
      CompositeState s;
      PointReport report;
      glass->respond(s, strain, 1e-7, report);
      REQUIRE(report.dissipation.plastic >= 0.0);
      const Moduli elastic{K, G};
      const SymmetricTensor trial = elastic.stress(strain);
      if (yield_function(trial) <= 0.0) {
        REQUIRE(s.plastic_strain == 0.0);
        REQUIRE(distance(s.stress, trial) < 1e-6);
        continue;
      }
      ++flowed;
      REQUIRE(std::abs(yield_function(s.stress)) < 1e-12 * effective_stress(trial));
      // Plastic strain = strain - elastic strain; its direction is d(q - beta_psi P)/d(sigma) at the end.
      const double psi = associated ? beta : 0.0;
      const SymmetricTensor plastic = strain - s.elastic_strain;
      const double multiplier = yield_function(trial) / (3.0 * G + K * beta * psi);
      const SymmetricTensor direction =
          (1.5 / effective_stress(s.stress)) * deviator(s.stress) + (psi / 3.0) * identity();
      REQUIRE(distance(plastic, multiplier * direction) < 1e-15);
      REQUIRE(s.plastic_strain == Approx(norm(plastic)).epsilon(1e-9));
      if (!associated) REQUIRE(trace(s.elastic_strain) == Approx(trace(strain)).epsilon(1e-12));
    }
    CHECK(flowed > 1000);
  }
}

TEST_CASE("proportional deviators under pressure are exact in one increment", "[material][drucker_prager]") {
  Random random(41);
  for (const bool associated : {false, true}) {
    const auto glass = composite_of(crushable_glass(associated), cell);
    for (int i = 0; i < 100; ++i) {
      const SymmetricTensor strain = random.uniform(5e-3, 1e-2) * random.deviatoric_direction() -
                                     random.uniform(1e-4, 1e-3) * identity();
      const Driven one = drive(*glass, {{strain, 1e-6}}, 1), many = drive(*glass, {{strain, 1e-6}}, 500);
      CAPTURE(associated, strain.rr, strain.zz, strain.tt, strain.rz);
      REQUIRE(one.state.plastic_strain > 0.0);
      REQUIRE(distance(one.state.stress, many.state.stress) < 1e-11 * norm(one.state.stress));
      REQUIRE(one.state.plastic_strain == Approx(many.state.plastic_strain).epsilon(1e-11));
      REQUIRE(one.time_of(EventKind::yield) == Approx(many.time_of(EventKind::yield)).epsilon(1e-9));
    }
  }
}

TEST_CASE("uniaxial-strain compression never yields", "[material][drucker_prager]") {
  const auto glass = composite_of(crushable_glass(false), cell);
  for (const double strain : {-1e-4, -1e-2, -0.5})
    CHECK(drive(*glass, {{{0.0, strain, 0.0, 0.0}, 1e-6}}, 3).state.plastic_strain == 0.0);
}

TEST_CASE("there is no plastic flow under tension", "[material][drucker_prager]") {
  const auto glass = composite_of(crushable_glass(false), cell);
  const SymmetricTensor shear{0.01, -0.01, 0.0, 0.0};
  const Driven stretched = drive(*glass, {{1e-5 * identity(), 1e-6}, {shear, 1e-6}}, 3);
  REQUIRE(effective_stress(stretched.state.stress) > 10.0 * yield);
  CHECK(stretched.state.plastic_strain == 0.0);

  SECTION("the shear that only tension allowed is released where pressure begins") {
    for (const int steps : {1, 10, 1000}) {
      const Driven pressed = drive(*glass, {{-2e-5 * identity(), 1e-6}}, steps, stretched.state);
      CAPTURE(steps);
      // At P = 0 the effective stress falls from q0 to sigma_y at constant strain; then pressure lifts the
      // strength above it.
      CHECK(effective_stress(pressed.state.stress) == Approx(yield).epsilon(1e-11));
      CHECK(pressed.count(EventKind::yield) == 1);
      CHECK(pressed.time_of(EventKind::yield) == Approx(0.5e-6).epsilon(1e-9));
      const double q0 = effective_stress(stretched.state.stress);
      CHECK(pressed.dissipation.plastic == Approx((q0 * q0 - yield * yield) / (6.0 * G)).epsilon(1e-9));
    }
  }
  SECTION("flow under pressure stops at zero pressure") {
    const Driven flowing = drive(*glass, {{-1e-4 * identity(), 1e-6}, {shear, 1e-6}}, 1);
    REQUIRE(flowing.state.plastic_strain > 0.0);
    for (const int steps : {1, 7}) {
      const Driven out = drive(*glass, {{3e-4 * identity(), 1e-6}}, steps, flowing.state);
      CAPTURE(steps);
      CHECK(effective_stress(out.state.stress) == Approx(yield).epsilon(1e-9));
      CHECK(trace(out.state.stress) == Approx(3.0 * K * 6e-4).epsilon(1e-9));
    }
  }
}

TEST_CASE("associated flow dilates, isochoric flow does not", "[material][drucker_prager]") {
  const SymmetricTensor strain{5e-3, -6e-3, 0.0, 2e-3};
  const auto dilating = composite_of(crushable_glass(true), cell);
  const Driven d = drive(*dilating, {{strain, 1e-6}}, 1);
  CHECK(trace(strain) - trace(d.state.elastic_strain) > 1e-4);
}

TEST_CASE("work = stored energy + dissipation in Drucker-Prager flow", "[material][drucker_prager]") {
  Random random(42);
  for (const bool associated : {false, true}) {
    const auto glass = composite_of(crushable_glass(associated), cell);
    for (int i = 0; i < 10; ++i) {
      const std::vector<Segment> path{{random.tensor(1e-3) - 2e-3 * identity(), 1e-6},
                                      {random.tensor(4e-3), 1e-6},
                                      {random.tensor(4e-3), 1e-6}};
      const Driven d = drive(*glass, path, 20000);
      CAPTURE(associated, i);
      const double balance = d.work - glass->stored_energy(d.state) - d.dissipation.plastic;
      // A violation released at zero pressure falls inside one increment, which the work integral sees at
      // first order.
      REQUIRE(std::abs(balance) < 1e-3 * (glass->stored_energy(d.state) + d.dissipation.plastic));
      REQUIRE(d.least_dissipation >= 0.0);
    }
  }
}
