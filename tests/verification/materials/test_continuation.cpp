// Where softening flow and a softening plane could each relieve the other, the plane opens: the paper applies
// von Mises flow "before the localization", the discrete law after it.
#include "catch.hpp"
#include "support/local_solvers.hpp"
#include "support/material_samples.hpp"
#include "support/random_states.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

MaterialParameters steel_with_plane(double mode_ratio, double opening) {
  MaterialParameters p = fracturing_steel();
  p.decohesion->mode_ratio = mode_ratio;
  p.decohesion->opening = opening;
  return p;
}

std::vector<Segment> turning_path(Random& random) {
  std::vector<Segment> path;
  SymmetricTensor at{};
  for (int i = random.integer(2, 3); i > 0; --i) {
    const SymmetricTensor to = 2.5e-2 * random.uniform(0.5, 1.0) * random.direction();
    path.push_back({to - at, 1e-5});
    at = to;
  }
  return path;
}

}  // namespace

TEST_CASE("all methods take the same continuation behind the onset of softening flow",
          "[local][von_mises][decohesion]") {
  Random random(23);
  for (const double mode_ratio : {0.3, 0.7, 1.0, 50.0})
    for (const double opening : {1e-5, 3e-5, 1e-4}) {
      const auto steel = composite_of(steel_with_plane(mode_ratio, opening), cell);
      int localised = 0;
      for (int i = 0; i < 15; ++i) {
        const std::vector<Segment> path = turning_path(random);
        const std::vector<LocalSolver> tight = solvers(1e-8);
        const Driven a = drive(*steel, path, 1, {}, tight[0].integrator.get());
        if (!is_localised(a.state)) continue;
        ++localised;
        CAPTURE(mode_ratio, opening, i);
        const double scale = 484e6;
        for (std::size_t k = 1; k < tight.size(); ++k) {
          const Driven b = drive(*steel, path, 1, {}, tight[k].integrator.get());
          CAPTURE(tight[k].name);
          CHECK(b.cause == "");
          CHECK(distance(a.state.stress, b.state.stress) < 1e-4 * scale);
          CHECK(b.dissipation.total() == Approx(a.dissipation.total()).epsilon(1e-4));
        }
        const Driven c = drive(*steel, path, 3000);  // of first order
        CHECK(distance(a.state.stress, c.state.stress) < 0.05 * scale);
        CHECK(c.dissipation.total() == Approx(a.dissipation.total()).epsilon(2e-2));
      }
      CHECK(localised >= 2);
    }
}

TEST_CASE("at the onset the plane opens and the stress goes inside the yield surface",
          "[local][von_mises][decohesion]") {
  // Strained on in the direction that localised it: plastic strain stays what it was at the onset.
  const auto steel = composite_of(steel_with_plane(0.7, 2e-5), cell);
  const std::vector<Segment> on{{{0.03, -0.03, 0.0, 0.0}, 1e-5}};
  const auto check = [&](const Driven& d) {
    REQUIRE(is_localised(d.state));
    CHECK(d.state.plastic_strain == Approx(VonMisesLaw(steel_von_mises()).peak_strain()).epsilon(1e-6));
    CHECK(is_separated(d.state));
  };
  check(drive(*steel, on, 300));
  for (const LocalSolver& solver : solvers(1e-6)) check(drive(*steel, on, 3, {}, solver.integrator.get()));
}
