// Softening flow and decohesion that drive each other faster than the strain does.
#include "catch.hpp"
#include "support/cracked_state.hpp"
#include "support/random_states.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

/// Steel on its softening branch whose plane has softened, too: stress on the yield surface and traction at
/// the strength.
CompositeState on_both_surfaces(const CompositeMaterial& steel, Random& random) {
  const VonMisesLaw law(*steel.parameters().von_mises);
  const double plastic = random.uniform(1.01 * law.peak_strain(), 0.9 * law.floor_strain());
  const double radius = law.radius(plastic), mean = random.uniform(0.0, 6.0) * radius;
  const SymmetricTensor shape = deviator(random.direction());
  const double angle = random.uniform(0.0, 3.0);
  const SymmetricTensor stress = mean * identity() + (radius / norm(shape)) * shape;
  const DecohesionLaw plane(*steel.parameters().decohesion);
  const double traction =
      plane.effective_traction(normal_traction(stress, angle), tangential_traction(stress, angle));
  const double decohesion = random.uniform(0.05, 0.95);
  CompositeState s = at_onset(steel, angle, traction / (1.0 - decohesion), stress);
  s.decohesion = decohesion, s.plastic_strain = plastic;
  return s;
}

}  // namespace

TEST_CASE("where flow and decohesion drive each other the point falls and loses what it had stored",
          "[material][von_mises][decohesion]") {
  Random random(20261128);
  long fell = 0, separated = 0;
  for (const double opening : {1e-6, 5e-6, 1e-4}) {
    MaterialParameters parameters = fracturing_steel();
    parameters.decohesion->opening = opening;
    const auto steel = composite_of(parameters, cell);
    const VonMisesLaw law(*parameters.von_mises);
    const DecohesionLaw plane_law(*parameters.decohesion);
    for (int n = 0; n < 300; ++n) {
      CAPTURE(opening, n);
      const CompositeState start = on_both_surfaces(*steel, random);
      const StrainPath path{1e-3 * random.direction(), 1e-6, 1e-6};
      CompositeMode mode;
      mode.tension = trace(start.elastic_strain) > 0.0;
      mode.flowing = true, mode.plane = CompositeMode::Plane::decohering;
      mode.pulled = normal_traction(start.stress, std::atan2(start.normal.z, start.normal.r)) > 0.0;
      mode.hardening_modulus = law.modulus(start.plastic_strain), mode.branch_end = law.floor_strain();
      CompositeMode without_flow = mode;
      without_flow.flowing = false;
      if (!(steel->modes().rates(without_flow, start, path).fraction > 0.0))
        continue;  // the plane snaps back alone

      CompositeState s = start;
      PointReport report;
      steel->modes().transition(mode, CompositeGuard::snap_back, s, path, 0.5, report);
      ++fell;
      const auto stored = [&](const CompositeState& of) {
        return steel->secant_moduli(of).energy(of.elastic_strain);
      };
      CHECK(report.dissipation.total() == Approx(stored(start) - stored(s)).epsilon(1e-9).margin(1e-9));
      CHECK(report.dissipation.plastic >= 0.0);
      CHECK(report.dissipation.fracture >= 0.0);
      CHECK(s.plastic_strain > start.plastic_strain);
      CHECK(s.decohesion >= start.decohesion);
      const Moduli m = steel->secant_moduli(s);
      CHECK(law.yield_function(s.elastic_strain, m, s.plastic_strain) <= 1e-6 * law.radius(0.0));
      if (is_separated(s)) {
        ++separated;
        continue;
      }
      const DecohesionPlane plane{s.normal};
      const SymmetricTensor stress = m.stress(s.elastic_strain);
      CHECK(plane_law.effective_traction(plane.normal_part(stress), plane.tangential_part(stress)) <=
            plane_law.strength(s.decohesion, s.cohesive_strength) + 1e-6 * s.cohesive_strength);
    }
  }
  CHECK(fell > 200);
  CHECK(separated > 0);
}
