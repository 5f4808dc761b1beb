// Stress at the start: profiles that are relaxed, and stay.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "app/stress_balance.hpp"
#include "app/warnings.hpp"
#include "catch.hpp"
#include "mpm/stress.hpp"
#include "support/mpm_run.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

/// A plate with the parabola of tempering through its thickness, 8 cells. foot: of its lower face.
MpmScene tempered(const std::string& geometry, const std::string& shape, int per_cell, bool relax,
                  double foot = 0.3) {
  MpmScene scene;
  scene.geometry = geometry, scene.shape = shape, scene.pace = "courant = 0.3";
  const bool axisymmetric = geometry == "axisymmetric";
  const std::string profile =
      fmt::format("\"=5e-4*(1 - 3*(({} - {})/4 - 1)^2)\"", axisymmetric ? "z" : "y", foot);
  scene.tables = body("plate", box({0.0, foot}, {20.0, 8.0 + foot}),
                      fmt::format("particles_per_cell = {}\nstress = [{}, 0, {}, 0]\nrelax = {}", per_cell,
                                  profile, axisymmetric ? profile : "0", relax));
  return scene;
}

/// Energy of a strain in an elastic body, J/m^3.
double energy_of(const SymmetricTensor& strain) {
  const double lame = unit_young * unit_poisson / ((1.0 + unit_poisson) * (1.0 - 2.0 * unit_poisson));
  return 0.5 * lame * trace(strain) * trace(strain) + unit_shear * contract(strain, strain);
}

/// Largest kinetic energy over the energy stored at the start, in a time.
double stir(const MpmScene& scene, double time) {
  MpmRun run(scene);
  const double stored = run.energy().elastic;
  double most = 0.0;
  run.watch = [&](double) { return most = std::max(most, run.system.record.kinetic), true; };
  run.advance(time);
  return most / stored;
}

}  // namespace

TEST_CASE("A tempered plate stays at rest once it is relaxed, and only then", "[verification][mpm][relax]") {
  for (const char* geometry : {"plane-strain", "axisymmetric"})
    for (const char* shape : {"linear", "gimp", "bspline2"})
      for (const int per_cell : {1, 4, 9})
        for (const char* gradients : {"nodes", "centroids"}) {
          CAPTURE(geometry, shape, per_cell, gradients);
          MpmScene scene = tempered(geometry, shape, per_cell, true);
          scene.gradients = gradients;
          CHECK(stir(scene, 20.0) < 1e-15);
        }
  CHECK(stir(tempered("plane-strain", "gimp", 1, false), 20.0) > 1e-4);
}

TEST_CASE("Relaxing moves nothing, and far from the rim changes little", "[verification][mpm][relax]") {
  for (const char* geometry : {"plane-strain", "axisymmetric"})
    for (const char* shape : {"linear", "gimp", "bspline2"})
      for (const int per_cell : {1, 4, 9}) {
        CAPTURE(geometry, shape, per_cell);
        // Wide functions hold a profile with one particle a cell in the middles of cells alone
        // (docs/theory/loads.md).
        const double foot = per_cell == 1 ? 0.0 : 0.3;
        const MpmRun run(tempered(geometry, shape, per_cell, true, foot)),
            given(tempered(geometry, shape, per_cell, false, foot));
        const Particles &p = run.system.bodies[0].particles, &q = given.system.bodies[0].particles;
        CHECK(p.position == q.position);
        CHECK(p.velocity == q.velocity);
        const TensorColumns s = mpm::stress_of(run.system.bodies[0]),
                            s0 = mpm::stress_of(given.system.bodies[0]);
        double largest = 0.0, change = 0.0, difference = 0.0, rim = 0.0;
        for (std::size_t i = 0; i < p.size; ++i) {
          const double from_rim =
              std::min(20.0 - p.position[0][i], run.system.axisymmetric ? 20.0 : p.position[0][i]);
          largest = std::max(largest, std::abs(s0[0][i]));
          if (from_rim < 1.0 / std::sqrt(per_cell)) rim = std::max(rim, std::abs(s[0][i]));
          for (std::size_t c = 0; c < 4 && from_rim > 8.0; ++c)
            change = std::max(change, std::abs(s[c][i] - s0[c][i]));
          const SymmetricTensor d = tensor_at(p.elastic_strain, i) - tensor_at(q.elastic_strain, i);
          difference += p.mass[i] * energy_of(d);  // density 1
        }
        CHECK(change < 0.04 * largest);
        CHECK(rim < 0.14 * largest);
        // The nearest one: what was given is the sum of two stresses that do no work on each other.
        CHECK(run.energy().elastic + difference == Approx(given.energy().elastic).epsilon(1e-9));
      }
}

TEST_CASE("One particle a cell between the lines of the grid is told of", "[verification][mpm][relax]") {
  for (const auto& [shape, per_cell, foot, told] :
       {std::tuple{"gimp", 1, 0.3, true}, std::tuple{"gimp", 1, 0.0, false},
        std::tuple{"bspline2", 4, 0.3, false}, std::tuple{"linear", 1, 0.3, false}}) {
    const Scene scene = parse_scene(tempered("plane-strain", shape, per_cell, true, foot).text(), "t");
    const app::Warnings list = app::warnings(scene, build_system(scene, 1), 1);
    CHECK(std::ranges::any_of(list, [](const std::string& line) {
            return line.find("off the lines of the grid") != std::string::npos;
          }) == told);
  }
}

TEST_CASE("A relaxed plate stays at rest in every integrator", "[verification][mpm][relax]") {
  for (const auto& [method, scheme, pace] :
       {std::array{"explicit", "usf", "courant = 0.3"}, std::array{"explicit", "usl", "courant = 0.1"},
        std::array{"explicit", "musl", "courant = 0.3"}, std::array{"arkode-explicit", "musl", "rtol = 1e-3"},
        std::array{"arkode-implicit", "musl", "rtol = 1e-3"}})
    for (const int per_cell : {1, 4}) {
      CAPTURE(method, scheme, per_cell);
      // USL amplifies rounding wherever a node is nearly empty (docs/theory/explicit.md): wide functions
      // always make some.
      const bool usl = scheme == std::string("usl");
      MpmScene scene = tempered("axisymmetric", usl ? "linear" : "gimp", per_cell, true);
      scene.method = method, scene.scheme = scheme, scene.pace = pace;
      CHECK(stir(scene, 20.0) < 1e-13);
    }
}

TEST_CASE("check tells what a profile lacks", "[verification][mpm][relax]") {
  const System balanced =
      build_system(parse_scene(tempered("axisymmetric", "linear", 4, false).text(), "t"), 1);
  const auto balance = app::stress_balance(balanced, balanced.bodies[0]);
  REQUIRE(balance);
  CHECK(balance->largest == Approx(8.2e-4).epsilon(0.02));  // a quarter of a cell from the faces
  CHECK(std::abs(balance->force) < 0.01 * 8.0 * 1e-3);      // the midpoint rule of 16 rows
  CHECK(std::abs(balance->moment) < 1e-12);
  // Relaxed, both vanish: it is a theorem of equilibrium.
  const System relaxed =
      build_system(parse_scene(tempered("axisymmetric", "linear", 4, true).text(), "t"), 1);
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
  for (const char* shape : {"linear", "gimp", "bspline2"})
    for (const int per_cell : {1, 4, 9}) {
      CAPTURE(shape, per_cell);
      MpmScene scene;
      scene.shape = shape, scene.pace = "courant = 0.3";
      scene.tables =
          body("column", box({0.0, 0.0}, {4.0, 20.0}),
               fmt::format("particles_per_cell = {}\nrelax = true", per_cell)) +
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
}

TEST_CASE("What nothing holds together is told", "[verification][mpm][relax]") {
  MpmScene scene;
  scene.tables = body("bar", box({0.0, 0.0}, {8.0, 4.0}), "relax = true") +
                 "[[traction]]\nbody = \"bar\"\nbox = {min = [-inf, 4], max = [inf, 4]}\npressure = 1e-4\n";
  CHECK_THROWS_AS(build_system(parse_scene(scene.text(), "t"), 1), ComputationError);
}

TEST_CASE("A uniform stress that nothing holds is relaxed to none", "[verification][mpm][relax]") {
  for (const char* geometry : {"plane-strain", "axisymmetric"})
    for (const char* shape : {"linear", "gimp", "bspline2"})
      for (const char* gradients : {"nodes", "centroids"}) {
        CAPTURE(geometry, shape, gradients);
        MpmScene scene;
        scene.geometry = geometry, scene.shape = shape, scene.gradients = gradients;
        const auto stored = [&](const std::string& region, bool relax) {
          scene.tables =
              body("block", region,
                   fmt::format("particles_per_cell = 9\nstress = [1e-3, 0, {}, 0]\nrelax = {}",
                               std::string(geometry) == "axisymmetric" ? 1e-3 : 1e-3 * unit_poisson, relax));
          return MpmRun(scene).energy().elastic;
        };
        const std::string block = box({0.0, 0.3}, {8.0, 4.3});
        // Between centroids a motion of an edge that they hardly see is left.
        const double left = std::string(gradients) == "nodes" ? 1e-10 : 1e-3;
        CHECK(stored(block, true) < left * stored(block, false));
        // What nodes do not see stays in the cut cells of a slope.
        const std::string slope = "polygon = [[0, 0.3], [8, 0.3], [8, 4.3], [0, 3.8]]";
        CHECK(stored(slope, true) < 0.1 * stored(slope, false));
      }
}
