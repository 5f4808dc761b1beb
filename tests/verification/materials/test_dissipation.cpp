#include "catch.hpp"
#include "support/material_samples.hpp"
#include "support/random_states.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

std::vector<Segment> random_path(Random& random, int segments, double largest) {
  std::vector<Segment> path;
  for (int k = 0; k < segments; ++k) {
    const double size = random.logarithmic(0.02 * largest, largest);
    path.push_back({random.tensor(size) + random.uniform(-0.7, 0.7) * size * identity(),
                    random.logarithmic(1e-8, 1e-5)});
  }
  return path;
}

}  // namespace

TEST_CASE("every composition on random paths: finite, within bounds, never negative dissipation",
          "[material][property]") {
  for (const NamedMaterial& named : all_compositions())
    for (const bool associated : {false, true}) {
      MaterialParameters p = named.parameters;
      if (p.drucker_prager) p.drucker_prager->associated = associated;
      if (p.decohesion) p.decohesion->search_all_planes = associated;
      const auto material = composite_of(p, cell);
      Random random(110);
      for (int i = 0; i < 500; ++i) {
        CAPTURE(named.name, associated, i);
        CompositeState s;
        for (const Segment& segment : random_path(random, 5, 1e-2)) {
          const int steps = random.integer(1, 4);
          for (int k = 0; k < steps; ++k) {
            const CompositeState before = s;
            PointReport report;
            material->respond(s, (1.0 / steps) * segment.strain, segment.duration / steps, report);
            REQUIRE(is_finite(s));
            const Dissipation& d = report.dissipation;
            REQUIRE(std::min({d.plastic, d.damage, d.fracture, d.snap_back}) >= 0.0);
            REQUIRE(d.snap_back <= d.fracture);
            REQUIRE(s.dissipated == Approx(before.dissipated + d.total()).epsilon(1e-12));
            for (const Component& column : material->columns()) {
              CAPTURE(column.name);
              REQUIRE(column.bounds.contain(number(s, column.name)));
            }
            REQUIRE(s.crack_density >= before.crack_density);
            REQUIRE(s.plastic_strain >= before.plastic_strain);
            REQUIRE(s.decohesion >= before.decohesion);
            REQUIRE(s.max_rate >= before.max_rate);
            REQUIRE((material->damage(s) >= 0.0 && material->damage(s) <= 1.0));
            REQUIRE(distance(s.stress, material->secant_moduli(s).stress(s.elastic_strain)) <=
                    1e-12 * norm(s.stress));
            for (std::size_t e = 0; e < report.events.size(); ++e) {
              REQUIRE(report.events[e].fraction >= 0.0);
              REQUIRE(report.events[e].fraction <= 1.0);
              if (e > 0) REQUIRE(report.events[e].fraction >= report.events[e - 1].fraction);
            }
            if (is_localised(s)) {
              const double n = std::hypot(s.normal.r, s.normal.z);
              REQUIRE((n == 0.0 || std::abs(n - 1.0) < 1e-12));
            }
          }
        }
      }
    }
}

TEST_CASE("every composition on random paths: work = stored + dissipated when refined",
          "[material][property][energy]") {
  for (const NamedMaterial& named : all_compositions())
    for (const bool associated : {false, true}) {
      MaterialParameters p = named.parameters;
      if (associated && !p.drucker_prager && !p.decohesion) continue;
      if (p.drucker_prager) p.drucker_prager->associated = associated;
      if (p.decohesion) p.decohesion->search_all_planes = associated;
      const auto material = composite_of(p, cell);
      Random random(111);
      for (int i = 0; i < 12; ++i) {
        const auto path = random_path(random, 4, 4e-3);
        const Driven d = drive(*material, path, 4000);
        const double accounted = material->stored_energy(d.state) + d.dissipation.total();
        CAPTURE(named.name, associated, i, d.work, material->stored_energy(d.state), d.dissipation.plastic,
                d.dissipation.damage, d.dissipation.fracture, d.dissipation.snap_back);
        CHECK(std::abs(d.work - accounted) < 5e-3 * accounted);
      }
    }
}
