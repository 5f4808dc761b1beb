#include "catch.hpp"
#include "support/cracked_state.hpp"
#include "support/random_states.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

/// Length of the chord that the line through the centre of a square of side 1 cuts off, by bisection along
/// the line.
double chord_through_centre(double angle_of_line) {
  double low = 0.0, high = 2.0;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    const bool inside = std::abs(middle * std::cos(angle_of_line)) <= 0.5 &&
                        std::abs(middle * std::sin(angle_of_line)) <= 0.5;
    (inside ? low : high) = middle;
  }
  return 2.0 * low;
}

}  // namespace

TEST_CASE("effective length is volume over plane area of a square cell", "[material][decohesion]") {
  Random random(60);
  for (int i = 0; i < 500; ++i) {
    const double angle = random.uniform(0.0, 2.0 * std::numbers::pi);
    const DecohesionPlane plane{std::cos(angle), std::sin(angle)};
    const double chord = chord_through_centre(angle + 0.5 * std::numbers::pi);
    REQUIRE(plane.effective_length(2.0e-3) == Approx(2.0e-3 / chord).epsilon(1e-12));
  }
  CHECK(DecohesionPlane{0.0, 0.0}.effective_length(2.0e-3) == 2.0e-3);
}

TEST_CASE("parts of a tensor on a plane, and the strain of a jump", "[material][decohesion]") {
  Random random(61);
  for (int i = 0; i < 500; ++i) {
    const double angle = random.uniform(-3.0, 3.0);
    const DecohesionPlane plane{std::cos(angle), std::sin(angle)};
    const SymmetricTensor a = random.tensor(1.0);
    REQUIRE(plane.normal_part(a) == Approx(normal_traction(a, angle)).margin(1e-14));
    REQUIRE(plane.tangential_part(a) == Approx(tangential_traction(a, angle)).margin(1e-14));
    // sym(n x u)/L does work tau.u/L on any stress.
    const double un = random.uniform(-1.0, 1.0), ut = random.uniform(-1.0, 1.0);
    const double work = contract(a, plane.jump_strain(un, ut, 0.5));
    REQUIRE(
        work ==
        Approx((normal_traction(a, angle) * un + tangential_traction(a, angle) * ut) / 0.5).margin(1e-13));
  }
  const DecohesionPlane hoop{0.0, 0.0};
  CHECK(hoop.jump_strain(1.0, 5.0, 0.5) == SymmetricTensor{0.0, 0.0, 2.0, 0.0});
  CHECK(hoop.normal_part({1.0, 2.0, 3.0, 4.0}) == 3.0);
  CHECK(hoop.tangential_part({1.0, 2.0, 3.0, 4.0}) == 0.0);
}

TEST_CASE("effective traction of eqs. 15 and 18 ignores compression", "[material][decohesion]") {
  DecohesionParameters p = glass_decohesion();
  const DecohesionLaw law(p);
  CHECK(law.effective_traction(3.0e6, 0.0) == Approx(3.0e6));
  CHECK(law.effective_traction(-3.0e6, 0.0) == 0.0);
  CHECK(law.effective_traction(-3.0e6, 100.0e6) == Approx(2.0e6));
  CHECK(law.effective_traction(3.0e6, -200.0e6) == Approx(5.0e6));
  // Eq. 18 with the result as tau_np: (tau_n/tau_np)^2 + (tau_t/(C_m tau_np))^2 = 1.
  Random random(62);
  for (int i = 0; i < 100; ++i) {
    p.mode_ratio = random.logarithmic(0.01, 100.0);
    const double n = random.uniform(0.0, 1e8), t = random.uniform(-1e8, 1e8);
    const double tau = DecohesionLaw(p).effective_traction(n, t);
    REQUIRE(std::pow(n / tau, 2.0) + std::pow(t / (p.mode_ratio * tau), 2.0) == Approx(1.0).epsilon(1e-12));
  }
}

TEST_CASE("surface energy is the integral of eq. 13", "[material][decohesion]") {
  Random random(63);
  for (const double q : {0.5, 1.0, 2.0, 5.0}) {
    DecohesionParameters p = glass_decohesion();
    p.q = q;
    const DecohesionLaw law(p);
    CHECK(law.surface_energy(0.0, 1.0, 1.0e8) ==
          Approx(500.0 * q / (q + 1.0)).epsilon(1e-13));  // U0 = 500 J/m^2
    CHECK(law.strength(0.0, 1.0e8) == 1.0e8);
    CHECK(law.strength(1.0, 1.0e8) == 0.0);
    for (int i = 0; i < 20; ++i) {
      const double a = random.uniform(0.0, 0.9), b = random.uniform(a, 1.0), middle = 0.5 * (a + b);
      const double whole = law.surface_energy(a, b, 1.0e8);
      REQUIRE(whole >= 0.0);
      REQUIRE(law.surface_energy(a, middle, 1.0e8) + law.surface_energy(middle, b, 1.0e8) == Approx(whole));
      REQUIRE(law.surface_energy(a, a + 1e-6, 1.0e8) ==
              Approx(5.0e-6 * 1e-6 * law.strength(a + 5e-7, 1.0e8)).epsilon(1e-5));
    }
  }
}

TEST_CASE("paper's glass in mode I snaps back where L_e exceeds M u0 / tau_np", "[material][decohesion]") {
  const DecohesionLaw law(glass_decohesion());
  const double M = 86.4e9;
  for (const double strength : {50.0e6, 200.0e6, 400.0e6, 800.0e6})
    for (const double length : {0.5e-3, 1.0e-3, 2.0e-3}) {
      const bool stable = length < M * 5.0e-6 / strength;
      const PlaneTraction onset{strength, 0.0, M, 28.8e9};
      CHECK((law.hardening_denominator(0.0, strength, onset, length) > 0.0) == stable);
    }
}
