#include "catch.hpp"
#include "support/material_samples.hpp"
#include "support/random_states.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

constexpr double G = 78.0e9, root = 0.816496580927726;  // shear modulus of the steel, sqrt(2/3)

/// Eq. 21 as printed, with the floor.
double strength_of(const VonMisesParameters& p, double I) {
  const double peak = (p.peak - p.yield) / p.hardening;
  return I < peak ? p.yield + p.hardening * I : std::max(p.peak - p.softening * (I - peak), 1e-3 * p.peak);
}

struct Proportional {
  double deviator;  // |s|
  double plastic;   // I
};
/// |s| and I when the deviatoric strain grows from zero along one direction up to `size`: piecewise linear,
/// branch by branch.
Proportional proportional_answer(const VonMisesParameters& p, double size) {
  const double peak = (p.peak - p.yield) / p.hardening, last = peak + 0.999 * p.peak / p.softening;
  double left = size - root * p.yield / (2.0 * G);
  if (left <= 0.0) return {2.0 * G * size, 0.0};
  const double hardening_strain = peak * (1.0 + root * p.hardening / (2.0 * G));
  if (left <= hardening_strain) {
    const double I = left / (1.0 + root * p.hardening / (2.0 * G));
    return {root * (p.yield + p.hardening * I), I};
  }
  left -= hardening_strain;
  const double softening_strain = (last - peak) * (1.0 - root * p.softening / (2.0 * G));
  if (left <= softening_strain) {
    const double I = left / (1.0 - root * p.softening / (2.0 * G));
    return {root * (p.peak - p.softening * I), peak + I};
  }
  return {root * 1e-3 * p.peak, last + left - softening_strain};
}

}  // namespace

TEST_CASE("peak and floor of the paper's steel", "[material][von_mises]") {
  const VonMisesLaw law(steel_von_mises());
  CHECK(law.peak_strain() == Approx(0.0130208).epsilon(1e-5));
  CHECK(law.floor_strain() == Approx(0.0130208 + 0.999 * 484.0 / 9600.0).epsilon(1e-5));
  CHECK(law.strength(0.0) == 359.0e6);
  CHECK(law.strength(law.peak_strain()) == Approx(484.0e6));
  CHECK(law.strength(0.0634375) == Approx(0.484e6));  // the strength would be zero here
  CHECK(law.strength(10.0) == Approx(0.484e6));
  Random random(10);
  for (int i = 0; i < 200; ++i) {
    const double I = random.uniform(0.0, 0.1);
    REQUIRE(law.strength(I) == Approx(strength_of(steel_von_mises(), I)).epsilon(1e-13));
  }
}

TEST_CASE("proportional paths are exact in one increment through every branch", "[material][von_mises]") {
  const auto steel = composite_of(flowing_steel(), cell);
  Random random(11);
  for (int i = 0; i < 2000; ++i) {
    const double size = random.logarithmic(1e-3, 0.2);
    const SymmetricTensor direction = random.deviatoric_direction();
    const double pressure_strain = random.uniform(-0.01, 0.01);
    const int steps = random.integer(1, 4);
    const Driven d = drive(*steel, {{size * direction + pressure_strain * identity(), 1e-6}}, steps);
    const Proportional expected = proportional_answer(steel_von_mises(), size);
    CAPTURE(size, steps);
    REQUIRE(distance(deviator(d.state.stress), expected.deviator * direction) < 1e-11 * 484.0e6);
    REQUIRE(d.state.plastic_strain == Approx(expected.plastic).epsilon(1e-11).margin(1e-15));
    REQUIRE(trace(d.state.stress) == Approx(3.0 * 130.0e9 * 3.0 * pressure_strain).epsilon(1e-9).margin(1.0));
  }
}

TEST_CASE("plastic states lie on the yield surface to 1e-12", "[material][von_mises]") {
  const auto steel = composite_of(flowing_steel(), cell);
  Random random(12);
  int flowed = 0;
  for (int i = 0; i < 2000; ++i) {
    CompositeState state;
    for (int k = 0; k < 5; ++k) {
      const double before = state.plastic_strain;
      PointReport report;
      steel->respond(state, random.tensor(random.logarithmic(1e-5, 2e-2)), 1e-7, report);
      const double radius = root * strength_of(steel_von_mises(), state.plastic_strain);
      REQUIRE(state.plastic_strain >= before);
      REQUIRE(report.dissipation.plastic >= 0.0);
      REQUIRE(norm(deviator(state.stress)) <= radius * (1.0 + 1e-12) + 1e-5);
      if (state.plastic_strain > before) {
        ++flowed;
        // Relative to the stress that the strain increment brings, whose rounding is what is left.
        REQUIRE(std::abs(norm(deviator(state.stress)) - radius) < 1e-12 * 484.0e6);
      }
    }
  }
  CHECK(flowed > 3000);
}

TEST_CASE("yield and peak are located inside the increment", "[material][von_mises][events]") {
  const auto steel = composite_of(flowing_steel(), cell);
  Random random(13);
  for (int i = 0; i < 100; ++i) {
    const double size = random.logarithmic(2.5e-2, 0.2);
    const Driven d = drive(*steel, {{size * random.deviatoric_direction(), 1.0}}, 1);
    const double yield_at = root * 359.0e6 / (2.0 * G) / size;
    const double peak_at = yield_at + 125.0 / 9600.0 * (1.0 + root * 9.6e9 / (2.0 * G)) / size;
    REQUIRE(d.count(EventKind::yield) == 1);
    REQUIRE(d.count(EventKind::peak) == 1);
    REQUIRE(d.time_of(EventKind::yield) == Approx(yield_at).epsilon(1e-10));
    REQUIRE(d.time_of(EventKind::peak) == Approx(peak_at).epsilon(1e-10));
  }
}

TEST_CASE("unloading and reloading are elastic, and yield is announced again",
          "[material][von_mises][events]") {
  const auto steel = composite_of(flowing_steel(), cell);
  const SymmetricTensor e{0.01, -0.005, -0.005, 0.0};
  const Driven loaded = drive(*steel, {{e, 1.0}}, 3);
  CHECK(loaded.count(EventKind::yield) == 1);
  const Driven unloaded = drive(*steel, {{-0.1 * e, 1.0}}, 2, loaded.state);
  CHECK(unloaded.state.plastic_strain == loaded.state.plastic_strain);
  CHECK(unloaded.events.empty());
  CHECK(distance(unloaded.state.stress, loaded.state.stress - 0.1 * 2.0 * G * e) < 1.0);
  const Driven reloaded = drive(*steel, {{0.2 * e, 1.0}}, 1, unloaded.state);
  CHECK(reloaded.count(EventKind::yield) == 1);
  CHECK(reloaded.time_of(EventKind::yield) == Approx(0.5).epsilon(1e-9));
}

TEST_CASE("work = stored energy + plastic dissipation", "[material][von_mises]") {
  const auto steel = composite_of(flowing_steel(), cell);
  const SymmetricTensor e{0.06, -0.02, -0.03, 0.03};
  const Driven d = drive(*steel, {{e, 1.0}}, 20000);
  const double balance = d.work - steel->stored_energy(d.state) - d.dissipation.plastic;
  CHECK(std::abs(balance) < 1e-6 * d.work);
  CHECK(drive(*steel, {{deviator(e), 1.0}}, 1).dissipation.plastic ==
        Approx(d.dissipation.plastic).epsilon(1e-11));
}

TEST_CASE("softening faster than elasticity can follow releases all at once and books the energy",
          "[material][von_mises]") {
  MaterialParameters p = flowing_steel();
  p.von_mises->softening = 1.0e13;
  const auto steel = composite_of(p, cell);
  const SymmetricTensor n = (1.0 / std::sqrt(6.0)) * SymmetricTensor{2.0, -1.0, -1.0, 0.0};
  for (const int steps : {1, 7, 1000}) {
    const Driven d = drive(*steel, {{0.05 * n, 1.0}}, steps);
    CAPTURE(steps);
    const double floor = root * 0.484e6;
    CHECK(norm(deviator(d.state.stress)) == Approx(floor).epsilon(1e-9));
    // |s| rises to the peak, collapses at constant strain, and stays on the floor.
    const double yielded = root * 359.0e6 / (2.0 * G), peak_I = 125.0 / 9600.0;
    const double peak_strain = yielded + peak_I * (1.0 + root * 9.6e9 / (2.0 * G));
    const double work = G * yielded * yielded + 0.5 * root * (359.0e6 + 484.0e6) * (peak_strain - yielded) +
                        floor * (0.05 - peak_strain);
    CHECK(d.dissipation.plastic + steel->stored_energy(d.state) == Approx(work).epsilon(1e-9));
  }
}
