// What a given state asks for before anything moves: one answer in all methods.
#include "catch.hpp"
#include "integrators/local/closed_form.hpp"
#include "support/local_solvers.hpp"
#include "support/material_samples.hpp"
#include "support/random_states.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

std::vector<LocalSolver> all_methods() {
  std::vector<LocalSolver> all = solvers(1e-8);
  all.push_back({"closed form", std::make_unique<ClosedForm>()});
  return all;
}

CompositeState judged(const CompositeMaterial& material, const SymmetricTensor& strain, PointReport& report) {
  CompositeState s;
  s.elastic_strain = strain;
  material.judge(s, report);
  return s;
}

}  // namespace

TEST_CASE("an initial tension is damaged up to the onset, then it localises, in all methods",
          "[material][local][damage][decohesion]") {
  // Uniaxial strain: x_cr .118315, D_cr .2013; then frozen, whatever the tension and whatever follows.
  const auto glass = composite_of(fracturing_glass(), cell);
  for (const double strain : {2e-4, 8.3333e-4, 5e-3}) {
    PointReport report;
    const CompositeState start = judged(*glass, {strain, 0.0, 0.0, 0.0}, report);
    CAPTURE(strain);
    CHECK(start.crack_density == Approx(0.118315 * crack_density_limit).epsilon(1e-5));
    CHECK(glass->damage(start) == Approx(0.2013).epsilon(1e-3));
    REQUIRE(report.events.size() == 2);
    CHECK(report.events[0].kind == EventKind::damage);
    CHECK(report.events[1].kind == EventKind::localisation);
    CHECK(report.events[1].fraction == 0.0);
    CHECK(start.cohesive_strength == Approx(start.stress.rr).epsilon(1e-12));
    const double undamaged = elastic_moduli(glass->parameters().elastic).energy(start.elastic_strain);
    CHECK(start.dissipated == Approx(undamaged - glass->stored_energy(start)).epsilon(1e-12));
    // Held, then moved on until it separates.
    const std::vector<Segment> path{{{}, 1e-6}, {{0.02, 0.0, 0.0, 0.0}, 1e-6}};
    const Driven exact = drive(*glass, path, 50, start);
    for (const LocalSolver& solver : all_methods()) {
      CAPTURE(solver.name);
      const Driven held = drive(*glass, {path[0]}, 5, start, solver.integrator.get());
      CHECK(held.state.crack_density == start.crack_density);
      CHECK(held.state.decohesion == 0.0);
      CHECK(held.dissipation.total() == 0.0);
      const Driven moved = drive(*glass, path, 5, start, solver.integrator.get());
      CHECK(moved.cause == "");
      CHECK(moved.state.crack_density == start.crack_density);
      CHECK(moved.count(EventKind::damage) + moved.count(EventKind::localisation) == 0);
      CHECK(is_separated(moved.state));
      CHECK(moved.time_of(EventKind::separation) ==
            Approx(exact.time_of(EventKind::separation)).epsilon(1e-6));
      CHECK(moved.dissipation.fracture == Approx(exact.dissipation.fracture).epsilon(1e-6));
    }
  }
}

TEST_CASE("a state that has been judged asks for nothing more, and its energy is booked",
          "[material][energy][property]") {
  Random random(61);
  for (const NamedMaterial& named : all_compositions()) {
    const auto material = composite_of(named.parameters, cell);
    int asked = 0;
    for (int i = 0; i < 200; ++i) {
      CAPTURE(named.name, i);
      PointReport report;
      const SymmetricTensor strain = random.logarithmic(1e-5, 3e-3) * random.direction();
      CompositeState s = judged(*material, strain, report);
      const double given = elastic_moduli(named.parameters.elastic).energy(strain);
      REQUIRE(report.dissipation.total() + material->stored_energy(s) == Approx(given).epsilon(1e-9));
      REQUIRE(s.dissipated == report.dissipation.total());
      asked += report.events.size() > 0 ? 1 : 0;
      // Held, in all methods.
      for (const LocalSolver& solver : all_methods()) {
        CAPTURE(solver.name);
        CompositeState held = s;
        PointReport later;
        material->integrate(*solver.integrator, held, {}, 1e-6, later);
        REQUIRE(later.cause == "");
        REQUIRE(later.dissipation.total() <= 1e-9 * given);
        REQUIRE(distance(held.stress, s.stress) <= 1e-6 * norm(s.stress));
      }
      PointReport again;
      const CompositeState before = s;
      material->judge(s, again);
      REQUIRE(again.dissipation.total() <= 1e-9 * given);
      REQUIRE(s.crack_density == before.crack_density);
    }
    CHECK((asked > 0) == (material->columns().size() > 0 && named.name != "elastic+decohesion"));
  }
}
