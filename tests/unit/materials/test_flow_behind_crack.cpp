#include "catch.hpp"
#include "support/cracked_state.hpp"
#include "support/random_states.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

TEST_CASE("a separated point that flows is on its yield surface and free of traction",
          "[material][von_mises][decohesion]") {
  Random random(140);
  const auto steel = make_material(fracturing_steel(), cell);
  const double root = std::sqrt(2.0 / 3.0);
  int flowed = 0;
  for (int i = 0; i < 200; ++i) {
    PointState s;
    PointReport first;
    steel->respond(s, {0.04, -0.04, 0.0, 0.0}, 1e-6, first);
    REQUIRE(is_separated(s));
    for (int k = 0; k < 6; ++k) {
      const double before = s.plastic_strain;
      PointReport report;
      steel->respond(s, random.tensor(5e-3), 1e-6, report);
      const double angle = std::atan2(s.normal_z, s.normal_r);
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
