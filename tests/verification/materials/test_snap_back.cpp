#include "catch.hpp"
#include "support/cracked_state.hpp"
#include "support/random_states.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

struct Balance {
  Driven driven;
  double lost;  // work - stored - dissipated, J/m^3
};

Balance follow_balance(const CompositeMaterial& material, const CompositeState& onset,
                       const SymmetricTensor& strain, int steps) {
  const Driven d = drive(material, {{strain, 1.0}}, steps, onset);
  return {d,
          d.work - (material.stored_energy(d.state) - material.stored_energy(onset)) - d.dissipation.total()};
}

}  // namespace

TEST_CASE("a release at once loses no energy", "[material][decohesion][energy]") {
  Random random(80);
  for (int i = 0; i < 200; ++i) {
    // A reference opening so small that nothing but the snap-back happens.
    const double strength = random.uniform(20e6, 400e6), angle = random.uniform(-3.0, 3.0);
    const auto glass = composite_of(cohesive_glass(1e-9, random.logarithmic(0.1, 50.0)), cell);
    const double mode = random.uniform(-1.5, 1.5), C = glass->parameters().decohesion->mode_ratio;
    const SymmetricTensor stress = strength * std::cos(mode) * normal_dyad(angle) +
                                   2.0 * strength * C * std::sin(mode) * shear_dyad(angle) +
                                   random.uniform(-1e7, 1e7) * SymmetricTensor{0.0, 0.0, 1.0, 0.0};
    const CompositeState onset = at_onset(*glass, angle, strength, stress);
    CompositeState s = onset;
    PointReport report;
    // So short that the increment itself does no work to speak of.
    glass->respond(s, 1e-13 * stress.rr / std::abs(stress.rr) * onset.elastic_strain, 1e-9, report);
    CompositeState loaded = onset;
    PointReport loaded_report;
    const double sign = contract(onset.stress, onset.elastic_strain) > 0.0 ? 1.0 : -1.0;
    glass->respond(loaded, sign * 1e-9 * onset.elastic_strain, 1e-9, loaded_report);
    REQUIRE(is_separated(loaded));
    const double released = glass->stored_energy(onset) - glass->stored_energy(loaded);
    REQUIRE(loaded_report.dissipation.fracture == Approx(released).epsilon(1e-7));
    const double surface = 0.5 * 1e-9 * strength / cell;
    REQUIRE(loaded_report.dissipation.snap_back == Approx(released - surface).epsilon(1e-6));
  }
}

TEST_CASE("softening that turns into a snap-back on its way loses no energy",
          "[material][decohesion][energy]") {
  Random random(81);
  int snapped = 0;
  for (int i = 0; i < 40; ++i) {
    // Mixed mode with C_m = 50: the normal traction goes first, and the shear that is left snaps back.
    const double strength = random.uniform(20e6, 100e6), angle = random.uniform(-3.0, 3.0);
    const auto glass = composite_of(cohesive_glass(5.0e-6, 50.0), cell);
    const double shear = random.uniform(-3.0, 3.0) * strength;
    const double normal = std::sqrt(strength * strength - shear * shear / 2500.0);
    const SymmetricTensor stress = normal * normal_dyad(angle) + 2.0 * shear * shear_dyad(angle);
    const CompositeState onset = at_onset(*glass, angle, strength, stress);
    const SymmetricTensor strain =
        8e-3 * normal_dyad(angle) + random.uniform(-2e-3, 2e-3) * shear_dyad(angle);
    const Balance fine = follow_balance(*glass, onset, strain, 20000);
    CAPTURE(i, strength, shear);
    REQUIRE(is_separated(fine.driven.state));
    REQUIRE(std::abs(fine.lost) < 2e-3 * fine.driven.dissipation.fracture);
    const Balance coarse = follow_balance(*glass, onset, strain, 1);
    REQUIRE(coarse.driven.dissipation.fracture == Approx(fine.driven.dissipation.fracture).epsilon(0.01));
    if (fine.driven.dissipation.snap_back > 0.01 * fine.driven.dissipation.fracture) ++snapped;
  }
  CHECK(snapped > 10);
}

TEST_CASE("exponents that snap back only at the end or only at the start lose no energy",
          "[material][decohesion][energy]") {
  const double strength = 50.0e6, M = 86.4e9;
  const SymmetricTensor stretch = normal_dyad(0.4);
  for (const double q : {0.5, 5.0})
    for (const int steps : {1, 10, 20000}) {
      const double opening =
          q < 1.0 ? 5.0e-5 : 1.2e-6;  // q = 5: stable until 5 lambda^4 = M u0/(L tau0) = 2.07
      const auto glass = composite_of(cohesive_glass(opening, 50.0, q), cell);
      const CompositeState onset =
          at_onset(*glass, 0.4, strength, strength / M * Moduli{48e9, 28.8e9}.stress(stretch));
      const Balance b = follow_balance(*glass, onset, (1.5 * opening / cell) * stretch, steps);
      CAPTURE(q, steps);
      REQUIRE(is_separated(b.driven.state));
      // Area under the curve of traction over strain, with the jumps at constant strain.
      const double k = opening * M / (cell * strength);  // dimensionless opening
      double area = 0.0;
      if (q < 1.0) {
        const double jump = 1.0 / (k * k);  // sqrt(lambda) = 1/k closes the first fall
        // After it: integral of (1 - sqrt(l)) d(k l - sqrt(l)).
        const auto primitive = [&](double l) {
          return k * l - std::sqrt(l) - k * l * std::sqrt(l) * 2.0 / 3.0 + 0.5 * l;
        };
        area = primitive(1.0) - primitive(jump);
      } else {
        const double turn = std::pow(k / 5.0, 0.25);  // d(k l - l^5) = 0
        const auto primitive = [&](double l) {
          return k * l - std::pow(l, 5.0) - k * std::pow(l, 6.0) / 6.0 + 0.5 * std::pow(l, 10.0);
        };
        area = primitive(turn) - primitive(0.0);
      }
      // Elastic energy at onset (uniaxial strain) goes too.
      const double expected = strength * strength / M * (area + 0.5);
      CHECK(b.driven.dissipation.fracture == Approx(expected).epsilon(1e-4));
      if (steps == 20000) CHECK(std::abs(b.lost) < 1e-3 * expected);
    }
}
