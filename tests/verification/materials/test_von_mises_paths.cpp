#include "catch.hpp"
#include "support/material_samples.hpp"
#include "support/random_states.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

constexpr double G = 78.0e9, root = 0.816496580927726;

MaterialParameters steel_with(double hardening) {
  MaterialParameters p = bare_steel();
  // A hardening branch without end, or none at all.
  p.von_mises = VonMisesParameters{359.0e6, hardening > 0.0 ? 1.0e15 : 359.0e6, hardening, 0.0};
  return p;
}

/// A state on the yield surface with deviator along `direction` (of unit norm).
CompositeState yielding_state(const SymmetricTensor& direction) {
  CompositeState s;
  s.elastic_strain = (root * 359.0e6 / (2.0 * G)) * direction;
  return s;
}

double angle_between(const SymmetricTensor& a, const SymmetricTensor& b) {
  const SymmetricTensor ua = (1.0 / norm(a)) * a, ub = (1.0 / norm(b)) * b;
  return 2.0 * std::atan2(norm(ua - ub), norm(ua + ub));  // accurate at every angle
}

/// Unit deviator at `angle` from `from`, in the plane of `from` and `towards`.
SymmetricTensor turned(const SymmetricTensor& from, const SymmetricTensor& towards, double angle) {
  SymmetricTensor across = towards - contract(towards, from) * from;
  across *= 1.0 / norm(across);
  return std::cos(angle) * from + std::sin(angle) * across;
}

}  // namespace

TEST_CASE("perfect plasticity turns the deviator by the tan(psi/2) law, at first order in the step",
          "[material][von_mises][convergence]") {
  const auto steel = composite_of(steel_with(0.0), cell);
  Random random(20);
  for (int i = 0; i < 20; ++i) {
    const double psi0 = random.uniform(0.2, 1.5);
    const SymmetricTensor s0 = random.deviatoric_direction();
    const SymmetricTensor rate = turned(s0, random.deviatoric_direction(), psi0);
    const double size = random.uniform(2e-3, 6e-3);
    const double exact = 2.0 * std::atan(std::tan(0.5 * psi0) * std::exp(-2.0 * G * size / (root * 359.0e6)));
    double previous = 0.0;
    for (const int steps : {400, 800, 1600}) {
      const Driven d = drive(*steel, {{size * rate, 1.0}}, steps, yielding_state(s0));
      const double error = std::abs(angle_between(deviator(d.state.stress), rate) - exact);
      REQUIRE(error < 5.0 / steps);
      if (previous > 0.0) REQUIRE(previous / error == Approx(2.0).epsilon(0.05));
      previous = error;
    }
  }
}

TEST_CASE("linear hardening follows |s| = R0 (sin psi0 / sin psi)^kappa",
          "[material][von_mises][convergence]") {
  Random random(21);
  for (const double hardening : {9.6e9, 60.0e9}) {
    const auto steel = composite_of(steel_with(hardening), cell);
    const double kappa = root * hardening / (2.0 * G + root * hardening);
    for (int i = 0; i < 10; ++i) {
      const double psi0 = random.uniform(0.4, 1.5);
      const SymmetricTensor s0 = random.deviatoric_direction();
      const SymmetricTensor rate = turned(s0, random.deviatoric_direction(), psi0);
      double previous = 0.0;
      for (const int steps : {500, 1000, 2000}) {
        const Driven d = drive(*steel, {{4e-3 * rate, 1.0}}, steps, yielding_state(s0));
        const SymmetricTensor s = deviator(d.state.stress);
        const double psi = angle_between(s, rate);
        const double exact = root * 359.0e6 * std::pow(std::sin(psi0) / std::sin(psi), kappa);
        const double error = std::abs(norm(s) - exact) / exact;
        REQUIRE(error < 1e-3);
        if (previous > 0.0) REQUIRE(previous / error == Approx(2.0).epsilon(0.1));
        previous = error;
        // Consistency: |s| = sqrt(2/3) (sigma_y + E_h I).
        REQUIRE(norm(s) == Approx(root * (359.0e6 + hardening * d.state.plastic_strain)).epsilon(1e-12));
      }
    }
  }
}
