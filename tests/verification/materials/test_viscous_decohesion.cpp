#include "catch.hpp"
#include "support/cracked_state.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

constexpr double M = 86.4e9, strength = 50.0e6, opening = 5.0e-6, angle = 0.3;

Driven soften(double viscosity, double strain, double duration, int steps,
              double reference_opening = opening) {
  const auto glass = make_material(cohesive_glass(reference_opening, 50.0, 1.0, viscosity), cell);
  const PointState onset =
      at_onset(*glass, angle, strength, strength / M * Moduli{48e9, 28.8e9}.stress(normal_dyad(angle)));
  return drive(*glass, {{strain * normal_dyad(angle), duration}}, steps, onset);
}

/// eta lambda' = tau/tau0 - (1 - lambda) with tau = tau0 + M (eps - u0 lambda/L): linear, solved exactly.
double exact_decohesion(double viscosity, double strain, double duration) {
  const double k = M * opening / (cell * strength);  // dimensionless opening
  const double drive_rate = M * strain / (strength * duration), decay = (k - 1.0) / viscosity;
  // lambda' = (drive_rate t - (k - 1) lambda)/eta
  const double steady = drive_rate / (k - 1.0);
  return steady * duration - steady / decay * (1.0 - std::exp(-decay * duration));
}

}  // namespace

TEST_CASE("viscous softening converges at first order to the solution of its equation",
          "[material][decohesion][viscosity][convergence]") {
  const double strain = 2.0e-3, duration = 1.0e-6, viscosity = 2.0e-6;
  const double exact = exact_decohesion(viscosity, strain, duration);
  REQUIRE(exact > 0.1);
  REQUIRE(exact < 0.9);
  double previous = 0.0;
  for (const int steps : {50, 100, 200, 400}) {
    const double error = std::abs(soften(viscosity, strain, duration, steps).state.decohesion - exact);
    CHECK(error < 1.0 / steps);
    if (previous > 0.0) CHECK(previous / error == Approx(2.0).epsilon(0.1));
    previous = error;
  }
}

TEST_CASE("viscous softening tends to the inviscid law as the viscosity vanishes",
          "[material][decohesion][viscosity]") {
  const double inviscid = soften(0.0, 2.0e-3, 1.0e-6, 100).state.decohesion;
  double previous = 1.0;
  for (const double viscosity : {1e-6, 1e-7, 1e-8, 1e-9}) {
    const double difference = std::abs(soften(viscosity, 2.0e-3, 1.0e-6, 100).state.decohesion - inviscid);
    CHECK(difference < 0.2 * previous);
    previous = difference;
  }
  CHECK(previous < 1e-3);
}

TEST_CASE("viscosity takes the jump out of a snap-back and loses no energy",
          "[material][decohesion][viscosity][energy]") {
  const Driven d = soften(1e-7, 2.0e-3, 1.0e-5, 20000, 1.0e-7);  // snaps back at once without viscosity
  REQUIRE(is_separated(d.state));
  const auto glass = make_material(cohesive_glass(1.0e-7, 50.0, 1.0, 1e-7), cell);
  const double initial = 0.5 * strength * strength / M;
  CHECK(d.work + initial - d.dissipation.total() - glass->stored_energy(d.state) ==
        Approx(0.0).margin(2e-3 * d.dissipation.total()));
  CHECK(d.least_dissipation >= 0.0);
}

TEST_CASE("a jump leaves a viscous plane no time to soften", "[material][decohesion][viscosity]") {
  const Driven d = soften(1e-7, 2.0e-3, 0.0, 1);
  CHECK(d.state.decohesion == 0.0);
  CHECK(normal_traction(d.state.stress, angle) == Approx(strength + M * 2.0e-3));
}
