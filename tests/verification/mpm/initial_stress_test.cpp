// Stress at the start: profiles that are relaxed, and stay.
#include <algorithm>
#include <cmath>

#include "app/stress_balance.hpp"
#include "catch.hpp"
#include "support/mpm_run.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

/// A plate with the parabola of tempering through its thickness, 8 cells.
MpmScene tempered(const std::string& geometry, const std::string& shape, const std::string& gradients,
                  bool relax) {
  MpmScene scene;
  scene.geometry = geometry, scene.shape = shape, scene.gradients = gradients, scene.pace = "courant = 0.3";
  const bool axisymmetric = geometry == "axisymmetric";
  const std::string profile = fmt::format("\"=5e-4*(1 - 3*(({} - 0.3)/4 - 1)^2)\"", axisymmetric ? "z" : "y");
  scene.tables = body("plate", box({0.0, 0.3}, {20.0, 8.3}),
                      fmt::format("particles_per_cell = 4\nstress = [{}, 0, {}, 0]\nrelax = {}", profile,
                                  axisymmetric ? profile : "0", relax));
  return scene;
}

}  // namespace

TEST_CASE("A tempered plate stays at rest once it is relaxed, and only then", "[verification][mpm][relax]") {
  for (const char* geometry : {"plane-strain", "axisymmetric"})
    for (const char* shape : {"linear", "bspline2"})
      for (const char* gradients : {"nodes", "centroids"}) {
        CAPTURE(geometry, shape, gradients);
        MpmRun run(tempered(geometry, shape, gradients, true)),
            as_given(tempered(geometry, shape, gradients, false));
        const double stored = run.energy().elastic;
        double most = 0.0, most_as_given = 0.0;
        run.watch = [&](double) { return most = std::max(most, run.system.record.kinetic), true; };
        as_given.watch = [&](double) {
          return most_as_given = std::max(most_as_given, as_given.system.record.kinetic), true;
        };
        run.advance(10.0), as_given.advance(10.0);
        CHECK(most < 1e-9 * stored);
        CHECK(most_as_given > 1e-4 * stored);
        // The middle keeps its profile, the rim has lost it.
        const Particles& p = run.particles();
        const double mid = 0.3 + 4.0;
        for (std::size_t i = 0; i < p.size; ++i)
          if ((run.system.axisymmetric ? p.position[0][i] < 6.0 : std::abs(p.position[0][i] - 10.0) < 2.0) &&
              std::abs(p.position[1][i] - mid) < 3.0) {
            const double z = (p.position[1][i] - 0.3) / 4.0 - 1.0;
            const double trace = p.elastic_strain[0][i] + p.elastic_strain[1][i] + p.elastic_strain[2][i];
            const double lame = unit_young * unit_poisson / ((1 + unit_poisson) * (1 - 2 * unit_poisson));
            CHECK(lame * trace + 2.0 * unit_shear * p.elastic_strain[0][i] ==
                  Approx(5e-4 * (1.0 - 3.0 * z * z)).margin(6e-5));
          }
      }
}

TEST_CASE("check tells what a profile lacks", "[verification][mpm][relax]") {
  const System balanced =
      build_system(parse_scene(tempered("axisymmetric", "linear", "nodes", false).text(), "t"), 1);
  const auto balance = app::stress_balance(balanced, balanced.bodies[0]);
  REQUIRE(balance);
  CHECK(balance->largest == Approx(8.2e-4).epsilon(0.02));  // a quarter of a cell from the faces
  CHECK(std::abs(balance->force) < 0.01 * 8.0 * 1e-3);      // the midpoint rule of 16 rows
  CHECK(std::abs(balance->moment) < 1e-12);
  // Relaxed, both vanish: it is a theorem of equilibrium.
  const System relaxed =
      build_system(parse_scene(tempered("axisymmetric", "linear", "nodes", true).text(), "t"), 1);
  const auto none = app::stress_balance(relaxed, relaxed.bodies[0]);
  CHECK(std::abs(none->force) < 1e-3 * 8.0 * 1e-3);
  // A uniform stress and a bent one.
  MpmScene scene;
  scene.tables = body("bar", box({0.0, 0.0}, {20.0, 8.0}), "stress = [\"=1e-3 + 1e-4*(y - 4)\", 0, 0, 0]");
  const System bent = build_system(parse_scene(scene.text(), "t"), 1);
  const auto found = app::stress_balance(bent, bent.bodies[0]);
  CHECK(found->force == Approx(8e-3));
  CHECK(found->moment == Approx(1e-4 * (512.0 - 8.0) / 12.0));  // the midpoint rule of 8 rows
}

TEST_CASE("A body is relaxed under its loads", "[verification][mpm][relax]") {
  // A column on the ground under its weight and a pressure on its top; what is held elsewhere does not
  // matter.
  MpmScene scene;
  scene.shape = "bspline2", scene.pace = "courant = 0.3";
  scene.tables =
      body("column", box({0.0, 0.0}, {4.0, 20.0}), "particles_per_cell = 4\nrelax = true") +
      body("other", box({20.0, 0.0}, {24.0, 4.0}), "stress = [1e-3, 0, 0, 0]") +
      hold("[-inf, -inf]", "[inf, 0]", "\"y\"") +
      "[gravity]\nacceleration = [0, -1e-5]\n"
      "[[traction]]\nbody = \"column\"\nbox = {min = [-inf, 20], max = [inf, 20]}\npressure = 2e-4\n";
  MpmRun run(scene);
  const Particles& p = run.particles();
  for (std::size_t i = 0; i < p.size; ++i)
    if (p.position[1][i] > 4.0 && p.position[1][i] < 16.0) {
      // Plane strain under s_yy alone: e_yy = (1 - nu^2) s / E.
      const double s = -2e-4 - 1e-5 * (20.0 - p.position[1][i]);
      CHECK(p.elastic_strain[1][i] ==
            Approx((1.0 - unit_poisson * unit_poisson) * s / unit_young).epsilon(0.03));
    }
  CHECK(run.energy().kinetic == 0.0);
  CHECK(run.particles(1).position ==
        build_system(parse_scene(scene.text(), "t"), 1).bodies[1].particles.position);
}

TEST_CASE("What nothing holds together is told", "[verification][mpm][relax]") {
  MpmScene scene;
  scene.tables = body("bar", box({0.0, 0.0}, {8.0, 4.0}), "relax = true") +
                 "[[traction]]\nbody = \"bar\"\nbox = {min = [-inf, 4], max = [inf, 4]}\npressure = 1e-4\n";
  CHECK_THROWS_AS(build_system(parse_scene(scene.text(), "t"), 1), ComputationError);
}
