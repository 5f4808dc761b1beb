#include "catch.hpp"
#include "support/cracked_state.hpp"
#include "support/literal_damage.hpp"
#include "support/random_states.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {
constexpr double M = 86.4e9, G = 28.8e9;  // undamaged glass
}

TEST_CASE("mode I follows sigma = tau0 [1 - (eps - eps0)/(u0/L_e - tau0/M)] on any plane",
          "[material][decohesion]") {
  Random random(70);
  const double opening = 5.0e-6;
  const auto glass = composite_of(cohesive_glass(opening, 50.0), cell);
  for (int i = 0; i < 100; ++i) {
    const double angle = random.uniform(-3.0, 3.0), strength = random.uniform(20e6, 300e6);
    const double length = random.uniform(0.5e-3, 1.0e-3);
    const double range = opening / length - strength / M;  // strain from onset to separation
    const SymmetricTensor stretch = normal_dyad(angle);
    const CompositeState onset =
        at_onset(*glass, angle, strength, strength / M * Moduli{48e9, G}.stress(stretch), length);
    const double share = random.uniform(0.05, 0.95);
    const int steps = random.integer(1, 30);
    CAPTURE(angle, strength, length, share, steps);
    const Driven part = drive(*glass, {{share * range * stretch, 1e-6}}, steps, onset);
    REQUIRE(normal_traction(part.state.stress, angle) == Approx(strength * (1.0 - share)).epsilon(1e-9));
    REQUIRE(std::abs(tangential_traction(part.state.stress, angle)) < 1e-6 * strength);
    REQUIRE(part.state.decohesion == Approx(share).epsilon(1e-9));
    REQUIRE(part.state.opening_n == Approx(share * opening).epsilon(1e-9));
    const Driven whole = drive(*glass, {{1.5 * range * stretch, 1.5}}, steps, onset);
    REQUIRE(is_separated(whole.state));
    REQUIRE(whole.time_of(EventKind::separation) == Approx(1.0).epsilon(1e-9));
    REQUIRE(std::abs(normal_traction(whole.state.stress, angle)) < 1e-6 * strength);
    // U0/2 per area, none of it from a snap-back.
    REQUIRE(whole.dissipation.fracture == Approx(0.5 * opening * strength / length).epsilon(1e-9));
    REQUIRE(whole.dissipation.snap_back < 1e-6 * whole.dissipation.fracture);
  }
}

TEST_CASE("a stable softening dissipates U0/2 whatever the mode", "[material][decohesion]") {
  Random random(71);
  for (int i = 0; i < 60; ++i) {
    const double mode_ratio = random.uniform(0.5, 2.0), opening = 5.0e-5, strength = 50.0e6;
    const auto glass = composite_of(cohesive_glass(opening, mode_ratio), cell);
    const double angle = random.uniform(-3.0, 3.0), mode = random.uniform(-1.5, 1.5);
    const double tau_n = strength * std::cos(mode), tau_t = strength * mode_ratio * std::sin(mode);
    const SymmetricTensor stress = tau_n * normal_dyad(angle) + 2.0 * tau_t * shear_dyad(angle);
    const CompositeState onset = at_onset(*glass, angle, strength, stress);
    const double turn = mode + random.uniform(-0.3, 0.3);
    const SymmetricTensor strain =
        0.4 * (std::abs(std::cos(turn)) * normal_dyad(angle) + 2.0 * std::sin(turn) * shear_dyad(angle));
    for (const int steps : {1, 2000}) {
      const Driven d = drive(*glass, {{strain, 1.0}}, steps, onset);
      CAPTURE(mode_ratio, angle, mode, turn, steps);
      REQUIRE(is_separated(d.state));
      REQUIRE(d.dissipation.fracture == Approx(0.5 * opening * strength / cell).epsilon(1e-3));
      if (steps > 1) {
        const double stored = glass->stored_energy(d.state) - glass->stored_energy(onset);
        REQUIRE(d.work - stored - d.dissipation.fracture ==
                Approx(0.0).margin(2e-3 * d.dissipation.fracture));
      }
    }
  }
}

TEST_CASE("other exponents q of eq. 13 in mode I", "[material][decohesion]") {
  const double strength = 50.0e6, opening = 5.0e-5;
  const SymmetricTensor stretch = normal_dyad(0.4);
  for (const double q : {0.5, 2.0, 5.0}) {
    const auto glass = composite_of(cohesive_glass(opening, 50.0, q), cell);
    const CompositeState onset =
        at_onset(*glass, 0.4, strength, strength / M * Moduli{48e9, G}.stress(stretch));
    for (const double lambda : {0.1, 0.5, 0.9})
      for (const int steps : {1, 17}) {
        const double strain = opening / cell * lambda - strength / M * std::pow(lambda, q);
        const Driven d = drive(*glass, {{strain * stretch, 1.0}}, steps, onset);
        CAPTURE(q, lambda, steps);
        CHECK(d.state.decohesion == Approx(lambda).epsilon(1e-8));
        CHECK(normal_traction(d.state.stress, 0.4) ==
              Approx(strength * (1.0 - std::pow(lambda, q))).epsilon(1e-8));
      }
    const Driven whole = drive(*glass, {{0.1 * stretch, 1.0}}, 1, onset);
    CHECK(is_separated(whole.state));
    // For q < 1 eq. 13 falls vertically at lambda = 0: a short snap-back adds to U0 q/(q + 1).
    if (q >= 1.0)
      CHECK(whole.dissipation.fracture == Approx(strength * opening / cell * q / (q + 1.0)).epsilon(1e-8));
  }
}

TEST_CASE("the paper's glass snaps back in mode I from 3.9e4 /s on", "[material][damage][decohesion]") {
  const auto moduli = literal_glass().moduli(0.118315 * 9.0 / 16.0);
  const double stiffness = moduli.bulk + 4.0 / 3.0 * moduli.shear;
  const double threshold = std::pow(stiffness * 5.0e-6 / cell / 10.808642e6, 3.0);
  CHECK(threshold == Approx(3.9e4).epsilon(0.01));
  CHECK(10.808642e6 * std::cbrt(threshold) == Approx(367.0e6).epsilon(0.002));
  const auto glass = composite_of(fracturing_glass(), cell);
  for (const int steps : {1, 40})
    for (const double factor : {0.99, 1.01}) {
      const double rate = factor * threshold;
      const Driven d = drive(*glass, {{{0.05, 0.0, 0.0, 0.0}, 0.05 / (3.0 * rate)}}, steps);
      CAPTURE(steps, factor);
      REQUIRE(is_separated(d.state));
      const double after = d.time_of(EventKind::separation) - d.time_of(EventKind::localisation);
      if (factor > 1.0) {
        CHECK(after < 1e-9 * d.time_of(EventKind::localisation));
        CHECK(d.dissipation.snap_back > 0.0);
      } else {
        CHECK(after > 1e-4 * d.time_of(EventKind::localisation));
        CHECK(d.dissipation.snap_back < 1e-6 * d.dissipation.fracture);
      }
    }
}

TEST_CASE("the paper's steel separates at the instant of localisation", "[material][von_mises][decohesion]") {
  const auto steel = composite_of(fracturing_steel(), cell);
  const Driven d = drive(*steel, {{{0.05, -0.05, 0.0, 0.0}, 1.0}}, 3);
  REQUIRE(is_separated(d.state));
  CHECK(d.time_of(EventKind::separation) == Approx(d.time_of(EventKind::localisation)).epsilon(1e-9));
  CHECK(d.dissipation.snap_back > 0.99 * d.dissipation.fracture);
}

TEST_CASE("decohesion never heals, and unloading keeps the opening", "[material][decohesion]") {
  const auto glass = composite_of(cohesive_glass(5.0e-5, 2.0), cell);
  Random random(72);
  const double strength = 50.0e6;
  for (int i = 0; i < 50; ++i) {
    const double angle = random.uniform(-3.0, 3.0);
    CompositeState s = at_onset(*glass, angle, strength, strength * normal_dyad(angle));
    for (int k = 0; k < 30; ++k) {
      const CompositeState before = s;
      PointReport report;
      glass->respond(s, random.tensor(5e-3), 1e-7, report);
      REQUIRE(s.decohesion >= before.decohesion);
      REQUIRE(report.dissipation.fracture >= 0.0);
      if (s.decohesion == before.decohesion && !is_separated(s)) {
        REQUIRE(s.opening_n == before.opening_n);
        REQUIRE(s.opening_t == before.opening_t);
      }
    }
  }
}
