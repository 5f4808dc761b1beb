// What jumps (snap-back, separation, falls onto the yield surface) set free is booked, whatever softens.
#include "catch.hpp"
#include "support/local_solvers.hpp"
#include "support/material_samples.hpp"
#include "support/random_states.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

/// Von Mises with decohesion: steel, and glass with damage, which softens faster than elasticity unloads
/// behind open faces.
std::vector<MaterialParameters> softening_materials() {
  std::vector<MaterialParameters> all;
  for (const double opening : {1.6e-9, 5e-6, 1e-4})
    for (const double q : {0.5, 1.0, 2.0})
      for (const double mode_ratio : {1.0, 50.0}) {
        const DecohesionParameters decohesion{opening, q, mode_ratio, 0.0, mode_ratio > 1.0};
        all.push_back(flowing_steel());
        all.back().decohesion = decohesion;
        all.push_back(damaging_glass());
        all.back().von_mises = VonMisesParameters{40e6, 50e6, 10e9, 40e9};
        all.back().decohesion = decohesion;
      }
  return all;
}

}  // namespace

TEST_CASE("every increment's loss of stored energy is booked, and plastic strain never falls",
          "[local][energy][extreme]") {
  Random random(4711);
  long separated = 0, snapped = 0;
  for (int sample = 0; sample < 3; ++sample)
    for (const MaterialParameters& p : softening_materials()) {
      const auto material = make_material(p, cell);
      const auto path =
          path_with_reversals(random, random.logarithmic(3e-4, 3e-2), random.logarithmic(1e2, 1e6), 4);
      constexpr int steps = 100;
      for (const LocalSolver& solver : solvers(1e-6)) {
        CAPTURE(sample, p.name, solver.name, p.decohesion->opening, p.decohesion->q,
                p.decohesion->mode_ratio);
        PointState s;
        for (const Segment& segment : path)
          for (int i = 0; i < steps; ++i) {
            const PointState before = s;
            const SymmetricTensor strain = (1.0 / steps) * segment.strain;
            PointReport report;
            solver.integrator->integrate(*material, s, strain, segment.duration / steps, report);
            REQUIRE(report.cause == "");
            REQUIRE(s.plastic_strain >= before.plastic_strain - 1e-12);
            const double stored = material->stored_energy(before),
                         missing = stored - material->stored_energy(s) - report.dissipation.total();
            // The strain's work: stress that rises elastically and falls within the increment included.
            const double rise = elastic_moduli(p.elastic).p_wave() * norm(strain),
                         largest = std::max(norm(before.stress), norm(s.stress)) + rise,
                         work = 2.0 * largest * norm(strain);
            REQUIRE(std::abs(missing) <= work + 0.02 * stored + 1.0);
            separated += is_separated(s) && !is_separated(before) ? 1 : 0;
            snapped += report.dissipation.snap_back > 0.0 ? 1 : 0;
          }
      }
    }
  CHECK(separated > 20);
  CHECK(snapped > 20);
}
