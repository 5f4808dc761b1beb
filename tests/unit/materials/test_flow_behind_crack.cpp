#include "catch.hpp"
#include "support/cracked_state.hpp"
#include "support/local_solvers.hpp"
#include "support/random_states.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

TEST_CASE("a separated point that flows is on its yield surface and free of traction",
          "[material][von_mises][decohesion]") {
  Random random(140);
  const auto steel = composite_of(fracturing_steel(), cell);
  const double root = std::sqrt(2.0 / 3.0);
  int flowed = 0;
  for (int i = 0; i < 200; ++i) {
    CompositeState s;
    PointReport first;
    steel->respond(s, {0.04, -0.04, 0.0, 0.0}, 1e-6, first);
    REQUIRE(is_separated(s));
    for (int k = 0; k < 6; ++k) {
      const double before = s.plastic_strain;
      PointReport report;
      steel->respond(s, random.tensor(5e-3), 1e-6, report);
      const double angle = std::atan2(s.normal.z, s.normal.r);
      const double radius = root * VonMisesLaw(steel_von_mises()).strength(s.plastic_strain);
      REQUIRE(norm(deviator(s.stress)) <= radius * (1.0 + 1e-6));
      REQUIRE(std::abs(tangential_traction(s.stress, angle)) < 1e-6 * 484e6);
      REQUIRE(normal_traction(s.stress, angle) < 1e-6 * 484e6);
      if (s.opening_n > 0.0) REQUIRE(std::abs(normal_traction(s.stress, angle)) < 1e-6 * 484e6);
      REQUIRE(report.dissipation.plastic >= 0.0);
      REQUIRE(report.dissipation.fracture == 0.0);
      if (s.plastic_strain > before) ++flowed;
    }
  }
  CHECK(flowed > 300);
}

namespace {

/// Materials that flow behind a separated plane, with or without damage.
std::vector<MaterialParameters> materials_that_flow() {
  std::vector<MaterialParameters> all{fracturing_steel()};
  for (const bool damage : {false, true})
    for (const int yielding : {0, 1, 2}) {
      MaterialParameters p = damage ? fracturing_glass() : bare_glass();
      p.decohesion = glass_decohesion();
      if (yielding == 2)
        p.von_mises = VonMisesParameters{40e6, 50e6, 10e9, 10e9};
      else
        p.drucker_prager = DruckerPragerParameters{43e6, 1.8, yielding == 1};
      all.push_back(p);
    }
  return all;
}

/// A separated point, its faces apart or in touch, damaged where the material can be.
CompositeState separated_point(const CompositeMaterial& material, Random& random, double size) {
  const double angle = random.uniform(-3.0, 3.0);
  CompositeState s = at_onset(material, angle, 50e6, {});
  s.decohesion = 1.0;
  s.opening_n = random.chance(0.5) ? 0.0 : random.uniform(0.0, 0.5) * size * cell;
  if (material.parameters().damage) s.crack_density = random.uniform(0.0, 0.3);
  return s;
}

}  // namespace

TEST_CASE("flow behind a separated plane ends on the yield surface, neither outside nor inside",
          "[material][decohesion][drucker_prager][von_mises]") {
  Random random(141);
  for (const MaterialParameters& p : materials_that_flow()) {
    const auto material = composite_of(p, cell);
    const double size = p.name == "steel" ? 5e-3 : 1e-3;
    int flowed = 0;
    for (int i = 0; i < 100; ++i) {
      CompositeState s = separated_point(*material, random, size);
      for (int k = 0; k < 6; ++k) {
        const CompositeState before = s;
        PointReport report;
        material->respond(s, random.tensor(size) - random.uniform(0.0, 0.5) * size * identity(), 1e-6,
                          report);
        CAPTURE(p.name, p.damage.has_value(), p.von_mises.has_value(), i, k);
        const double angle = std::atan2(s.normal.z, s.normal.r), scale = 1e-6 * norm(s.stress) + 1.0;
        REQUIRE(std::abs(tangential_traction(s.stress, angle)) < scale);
        REQUIRE(normal_traction(s.stress, angle) < scale);
        if (s.opening_n > 0.0) REQUIRE(normal_traction(s.stress, angle) > -scale);
        REQUIRE(s.plastic_strain >= before.plastic_strain);
        if (before.opening_n > 0.0 && s.opening_n == 0.0) {  // shut, by the strain or by the flow
          REQUIRE(report.events.size() > 0);
          bool closes = false;
          for (std::size_t e = 0; e < report.events.size(); ++e)
            closes = closes || report.events[e].kind == EventKind::closure;
          REQUIRE(closes);
        }
        if (s.plastic_strain == before.plastic_strain) continue;
        // (Where the faces give way so that the mean strain turns positive, Drucker-Prager has no surface.)
        if (p.drucker_prager && trace(s.elastic_strain) > 0.0) continue;
        const Moduli m = material->secant_moduli(s);
        const double f =
            p.drucker_prager
                ? DruckerPragerLaw(*p.drucker_prager).yield_function(s.elastic_strain, m)
                : VonMisesLaw(*p.von_mises).yield_function(s.elastic_strain, m, s.plastic_strain);
        REQUIRE(std::abs(f) <=
                1e-6 * elastic_moduli(p.elastic).shear * norm(before.elastic_strain) + 1e-6 * 43e6);
        ++flowed;
      }
    }
    CAPTURE(p.name, p.damage.has_value(), p.von_mises.has_value());
    CHECK(flowed > 15);
  }
}

TEST_CASE("associated Drucker-Prager behind a separated plane falls onto its surface",
          "[material][local][decohesion][drucker_prager]") {
  // Dissipation 347.26 kJ/m^3, end s_rr -198.4 MPa: an independent integration in tiny steps. All three
  // methods flowed three times too much when pressure began (299.3 kJ/m^3, -234.8 MPa).
  MaterialParameters p = fracturing_glass();
  p.drucker_prager = DruckerPragerParameters{43e6, 1.8, true};
  const auto glass = composite_of(p, cell);
  const SymmetricTensor open{0.0052, 0.0003, 0.0028, -0.0005}, end{-0.0031, 0.0007, 0.0013, -0.001};
  const std::vector<Segment> path{{open, 1e-6}, {end - open, 2e-6}};
  const auto check = [](const Driven& d, double error) {
    CHECK(d.dissipation.total() == Approx(347.26e3).epsilon(error));
    CHECK(d.state.stress.rr == Approx(-198.4e6).epsilon(error + 2e-4));
  };
  check(drive(*glass, path, 400), 3e-3);
  for (const LocalSolver& solver : solvers(1e-9)) {
    CAPTURE(solver.name);
    check(drive(*glass, path, 400, {}, solver.integrator.get()), 1e-4);
  }
}
