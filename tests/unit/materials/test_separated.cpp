#include "catch.hpp"
#include "support/cracked_state.hpp"
#include "support/random_states.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

constexpr double M = 86.4e9, G = 28.8e9;

/// A separated point without stress, its faces in touch.
CompositeState separated(const CompositeMaterial& material, double angle) {
  CompositeState s = at_onset(material, angle, 50.0e6, {});
  s.decohesion = 1.0;
  return s;
}

}  // namespace

TEST_CASE("an open crack carries no traction, a closed one only pressure",
          "[material][decohesion][contact]") {
  const auto glass = composite_of(cohesive_glass(5.0e-6), cell);
  Random random(90);
  for (int i = 0; i < 100; ++i) {
    const double angle = random.uniform(-3.0, 3.0);
    CompositeState s = separated(*glass, angle);
    for (int k = 0; k < 30; ++k) {
      PointReport report;
      glass->respond(s, random.tensor(1e-3), 1e-7, report);
      const double tau_n = normal_traction(s.stress, angle), tau_t = tangential_traction(s.stress, angle);
      REQUIRE(s.opening_n >= 0.0);
      REQUIRE(std::abs(tau_t) < 1.0);  // frictionless; strains of 1e-3 mean stresses of 1e8
      REQUIRE(tau_n < 1.0);
      if (s.opening_n > 0.0) REQUIRE(std::abs(tau_n) < 1.0);
      REQUIRE(report.dissipation.total() == 0.0);
      REQUIRE(s.decohesion == 1.0);
    }
  }
}

TEST_CASE("a crack closes where its gap is used up, and opens again", "[material][decohesion][contact]") {
  const auto glass = composite_of(cohesive_glass(5.0e-6), cell);
  Random random(91);
  for (int i = 0; i < 50; ++i) {
    const double angle = random.uniform(-3.0, 3.0), strain = random.logarithmic(1e-5, 1e-2);
    const SymmetricTensor stretch = normal_dyad(angle);
    const CompositeState start = separated(*glass, angle);
    const Driven open = drive(*glass, {{strain * stretch, 1.0}}, 1, start);
    REQUIRE(open.state.opening_n == Approx(strain * cell).epsilon(1e-9));
    REQUIRE(norm(open.state.stress) < 1e-3);
    for (const int steps : {1, 3}) {
      const Driven closed = drive(*glass, {{-3.0 * strain * stretch, 3.0}}, steps, open.state);
      REQUIRE(closed.count(EventKind::closure) == 1);
      REQUIRE(closed.time_of(EventKind::closure) == Approx(1.0).epsilon(1e-9));
      REQUIRE(closed.state.opening_n == 0.0);
      REQUIRE(normal_traction(closed.state.stress, angle) == Approx(-2.0 * strain * M).epsilon(1e-9));
      const Driven reopened = drive(*glass, {{3.0 * strain * stretch, 3.0}}, steps, closed.state);
      REQUIRE(reopened.state.opening_n == Approx(strain * cell).epsilon(1e-9));
      REQUIRE(norm(reopened.state.stress) < 1e-6 * M * strain + 1e-3);
    }
  }
}

TEST_CASE("faces slide without resistance, open or closed", "[material][decohesion][contact]") {
  const auto glass = composite_of(cohesive_glass(5.0e-6), cell);
  for (const double normal : {-1e-3, 1e-3}) {
    const double angle = 0.7,
                 shear = 2e-4;  // sym(n x t) shear: the jump is twice the tensor shear times the length
    const Driven d = drive(*glass, {{normal * normal_dyad(angle) + 2.0 * shear * shear_dyad(angle), 1.0}}, 3,
                           separated(*glass, angle));
    CAPTURE(normal);
    CHECK(d.state.opening_t == Approx(2.0 * shear * cell).epsilon(1e-9));
    CHECK(d.state.opening_n == Approx(std::max(normal, 0.0) * cell).epsilon(1e-9).margin(1e-18));
    CHECK(std::abs(tangential_traction(d.state.stress, angle)) < 1.0);
  }
}

TEST_CASE("a separated point is elastic: the work of a closed strain cycle is nothing",
          "[material][decohesion][contact]") {
  const auto glass = composite_of(cohesive_glass(5.0e-6), cell);
  Random random(92);
  for (int i = 0; i < 10; ++i) {
    const CompositeState start = separated(*glass, random.uniform(-3.0, 3.0));
    const SymmetricTensor a = random.tensor(1e-3), b = random.tensor(1e-3);
    const Driven d = drive(*glass, {{a, 1.0}, {b, 1.0}, {-1.0 * (a + b), 1.0}}, 4000, start);
    REQUIRE(std::abs(d.work) < 1e-4 * G * contract(a, a));
    REQUIRE(norm(d.state.stress) < 1e-3);
    REQUIRE(d.state.opening_n < 1e-12);
  }
}

TEST_CASE("a hoop plane opens in the hoop direction alone", "[material][decohesion][hoop]") {
  const auto glass = composite_of(fracturing_glass(true), cell);
  const Driven d = drive(*glass, {{{0.0, 0.0, 0.05, 0.0}, 1e-5}, {{2e-4, -1e-4, 0.01, 1e-4}, 1e-6}}, 3);
  REQUIRE(is_separated(d.state));
  CHECK(d.state.normal.r == 0.0);
  CHECK(d.state.normal.z == 0.0);
  CHECK(d.state.effective_length == cell);
  CHECK(std::abs(d.state.stress.tt) < 1.0);
  CHECK(d.state.opening_t == 0.0);
  // Stress in the plane of the point goes on; with sigma_tt = 0 it is that of plane stress.
  CHECK(std::abs(d.state.stress.rr) > 1e6);
  CHECK(d.state.stress.rz == Approx(2.0 * glass->secant_moduli(d.state).shear * 1e-4).epsilon(1e-9));
  const Driven closed = drive(*glass, {{{0.0, 0.0, -0.08, 0.0}, 1e-5}}, 2, d.state);
  CHECK(closed.count(EventKind::closure) == 1);
  CHECK(closed.state.opening_n == 0.0);
  CHECK(closed.state.stress.tt < -1e8);
}
