#include "catch.hpp"
#include "support/cracked_state.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

constexpr double M = 86.4e9, strength = 50.0e6, opening = 5.0e-6, angle = 0.3;

Driven soften(double viscosity, double strain, double duration, int steps,
              double reference_opening = opening) {
  const auto glass = composite_of(cohesive_glass(reference_opening, 50.0, 1.0, viscosity), cell);
  const CompositeState onset =
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
  const auto glass = composite_of(cohesive_glass(1.0e-7, 50.0, 1.0, 1e-7), cell);
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

TEST_CASE("the Jacobian of viscous decohesion against differences", "[local][verification]") {
  Random random(99);
  MaterialParameters p = fracturing_glass();
  p.decohesion->viscosity = 1e-9;
  const auto glass = composite_of(p, cell);
  const CompositeState onset = drive(*glass, {{{1.7e-3, 0, 0, 4e-4}, 6e-7}}, 1).state;
  REQUIRE(is_localised(onset));
  for (int sample = 0; sample < 200; ++sample) {
    CompositeState s = onset;
    s.decohesion = random.uniform(0.05, 0.9);
    s.elastic_strain += 3e-4 * random.direction();
    CompositeMode mode;
    mode.plane = CompositeMode::Plane::decohering;
    mode.tension = mode.viscous = true;
    mode.pulled = random.chance(0.8);
    const StrainPath path{2e-4 * random.direction(), 1e-7};
    const OpeningJacobian J = glass->modes().opening_jacobian(mode, s, path);
    const DecohesionPlane plane{s.normal};
    const auto rates_after = [&](std::size_t j, double change) {
      CompositeState moved = s;
      if (j == 0) moved.decohesion += change;
      if (j == 1) moved.elastic_strain -= plane.jump_strain(change, 0.0, s.effective_length);
      if (j == 2) moved.elastic_strain -= plane.jump_strain(0.0, change, s.effective_length);
      const CompositeRates r = glass->modes().rates(mode, moved, path);
      return std::array<double, 4>{r.decohesion, r.opening_n, r.opening_t, r.fracture};
    };
    for (std::size_t j = 0; j < 3; ++j) {
      const double h = j == 0 ? 1e-6 : 1e-11;
      const auto up = rates_after(j, h), down = rates_after(j, -h);
      for (std::size_t i = 0; i < 4; ++i) {
        const double difference = (up[i] - down[i]) / (2.0 * h);
        const double size = std::abs(J[i][0]) * (j == 0 ? 1.0 : 2e5) + std::abs(J[i][j]);
        CAPTURE(sample, i, j);
        CHECK(std::abs(J[i][j] - difference) <= 1e-4 * size + 1e-9 * std::abs(up[i]) / h);
      }
    }
  }
}
