// Boxes of held or driven nodes: that they move with their velocity, take along what they hold, and do
// exactly the work that they seem to.
#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "support/mpm_run.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

struct Method {
  const char *name, *method, *scheme;
};
constexpr Method methods[] = {{"usf", "explicit", "usf"},
                              {"usl", "explicit", "usl"},
                              {"musl", "explicit", "musl"},
                              {"arkode-explicit", "arkode-explicit", "musl"},
                              {"arkode-implicit", "arkode-implicit", "musl"}};

MpmScene with_method(MpmScene scene, const Method& method) {
  scene.method = method.method, scene.scheme = method.scheme;
  if (scene.method == "explicit") return scene;
  scene.pace = "rtol = 1e-3";
  // Short phases: their ends filter what particles carry and nodes cannot, and that is energy lost.
  if (scene.method == "arkode-implicit") scene.pace += "\nremap_travel = 0.02";
  return scene;
}

std::string driven(const std::string& min, const std::string& max, const std::string& fix,
                   std::array<double, 2> velocity, const std::string& more = "") {
  return hold(min, max, fix, velocity) + more + "\n";
}

double mean(const Particles& p, const std::vector<double>& values) {
  return mass_mean(p, values);
}

/// A block, 5 x 10 cells (length and wave speed 1), on a table; a die on top presses it by 2 cells within the
/// time that a wave takes for some lengths of the block. up: the table moves up instead, and the block with
/// it.
MpmScene press(const std::string& shape, double speed, bool up) {
  MpmScene scene;
  scene.shape = shape, scene.pace = "courant = 0.4";
  const double die = up ? 0.0 : -speed, table = up ? speed : 0.0;
  scene.tables = body("block", box({0.0, 0.0}, {5.0, 10.0}),
                      "particles_per_cell = 4\nvelocity = " + pair({0.0, table})) +
                 driven("[-inf, -1000]", "[inf, 0]", "\"y\"", {0.0, table}) +
                 driven("[-inf, 10]", "[inf, 1000]", "\"y\"", {0.0, die});
  return scene;
}

}  // namespace

TEST_CASE("A die presses a block by the way that it goes, and does the work that the block gets",
          "[verification][mpm][boundaries]") {
  constexpr double speed = 0.02, way = 2.0;
  for (const Method& method : methods)
    for (const bool up : {false, true}) {
      CAPTURE(method.name, up);
      MpmRun run(with_method(press("bspline2", speed, up), method));
      run.advance(way / speed);
      const Particles& p = run.particles();
      const auto [lowest, highest] = std::minmax_element(p.position[1].begin(), p.position[1].end());
      // Outermost particles are a quarter of a cell, pressed like all, from the block's faces.
      const double height = (*highest - *lowest) * 10.0 / 9.5;
      CHECK(height == Approx(8.0).margin(0.15));
      const EnergyTotals& e = run.energy();
      CHECK(e.elastic > 0.8 * std::abs(e.external));
      CHECK(std::abs(e.relative_residual()) < 0.01);
    }
}

TEST_CASE("A die that draws away does not let go", "[verification][mpm][boundaries]") {
  // The die holds the upper quarter of a bar and draws it up by two cells, with both components held: the bar
  // becomes 10 % longer, and its upper part moves as the die does.
  constexpr double speed = 0.02, way = 2.0;
  for (const Method& method : methods) {
    CAPTURE(method.name);
    MpmScene scene;
    scene.shape = "bspline2", scene.pace = "courant = 0.4";
    scene.tables = body("bar", box({0.0, 0.0}, {4.0, 24.0}), "particles_per_cell = 4") +
                   driven("[-inf, -1000]", "[inf, 2]", "\"x\", \"y\"", {0.0, 0.0}) +
                   driven("[-inf, 22]", "[inf, 1000]", "\"x\", \"y\"", {0.0, speed});
    MpmRun run(with_method(scene, method));
    const std::vector<double> start = run.particles().position[1];
    run.advance(way / speed);
    const Particles& p = run.particles();
    for (std::size_t i = 0; i < p.size; ++i) {
      if (start[i] > 22.0) {
        CHECK(p.position[1][i] - start[i] == Approx(way).epsilon(0.01));
        if (start[i] > 23.0) CHECK(p.velocity[1][i] == speed);  // all its nodes are held
      }
      if (start[i] < 1.0) CHECK(p.position[1][i] == start[i]);
    }
    CHECK(std::abs(run.energy().relative_residual()) < 0.01);
  }
}

TEST_CASE("A driven box that stays lets what it drives through", "[verification][mpm][boundaries]") {
  for (const bool moves : {true, false}) {
    CAPTURE(moves);
    MpmScene scene;
    scene.pace = "courant = 0.4";
    scene.tables = body("block", box({0.0, 0.0}, {4.0, 4.0}), "particles_per_cell = 4") +
                   driven("[-1, -1]", "[5, 5]", "\"x\", \"y\"", {0.0, 0.5}, moves ? "" : "moves = false");
    MpmRun run(scene);
    run.advance(40.0);
    const Particles& p = run.particles();
    double speed = 0.0;
    for (std::size_t i = 0; i < p.size; ++i) speed = std::max(speed, std::abs(p.velocity[1][i] - 0.5));
    CHECK(speed < 1e-12);  // rigid flight, within the box and beyond it
    CHECK(mean(p, p.position[1]) == Approx(2.0 + 0.5 * 40.0).epsilon(1e-12));
    // Outside the box the nodes are free: a velocity given to the particles stays theirs.
    for (double& v : run.particles().velocity[1]) v = 0.25;
    run.system.grid_is_stale = true;
    run.advance(41.0);
    CHECK(run.particles().velocity[1][0] == Approx(moves ? 0.5 : 0.25).epsilon(1e-12));
  }
}

TEST_CASE("Particles whose nodes are all held have the velocity of their motion, and its work is booked",
          "[verification][mpm][boundaries]") {
  struct Case {
    std::array<double, 2> initial, prescribed;
  };
  for (const Case& c : {Case{{0.0, -0.01}, {0.0, 0.0}}, Case{{0.0, 0.0}, {0.003, 0.005}},
                        Case{{0.02, -0.01}, {-0.003, 0.005}}})
    for (const Method& method : methods)
      for (const char* shape : {"linear", "gimp", "bspline2"})
        for (const char* geometry : {"plane-strain", "axisymmetric"}) {
          if (geometry[0] == 'a' && (c.initial[0] != 0.0 || c.prescribed[0] != 0.0)) continue;
          CAPTURE(method.name, shape, geometry, c.prescribed);
          MpmScene scene;
          scene.geometry = geometry, scene.shape = shape, scene.pace = "courant = 0.4";
          scene.tables = body("block", box({0.0, 0.0}, {4.0, 4.0}),
                              "particles_per_cell = 4\nvelocity = " + pair(c.initial)) +
                         hold("[-inf, -inf]", "[inf, inf]",
                              geometry[0] == 'a' ? "\"r\", \"z\"" : "\"x\", \"y\"", c.prescribed);
          MpmRun run(with_method(scene, method));
          const std::vector<double> start[2] = {run.particles().position[0], run.particles().position[1]};
          run.advance(20.0);
          const Particles& p = run.particles();
          double mass = 0.0, speed2 = 0.0;
          for (std::size_t k = 0; k < 2; ++k) {
            for (std::size_t i = 0; i < p.size; ++i) {
              CHECK(p.velocity[k][i] == c.prescribed[k]);
              CHECK(p.position[k][i] - start[k][i] == Approx(20.0 * c.prescribed[k]).margin(1e-12));
            }
            speed2 += c.prescribed[k] * c.prescribed[k];
          }
          for (const double m : p.mass) mass += m;
          const EnergyTotals& e = run.energy();
          CHECK(e.kinetic == Approx(0.5 * mass * speed2).margin(1e-18));
          CHECK(e.external == Approx(e.kinetic - e.initial).epsilon(1e-12));
          CHECK(std::abs(e.elastic) < 1e-20);
        }
}

TEST_CASE("Between boxes of different velocities particles have that of their motion",
          "[verification][mpm][boundaries]") {
  // Every node is driven, the left ones at another velocity than the right ones: the field between them is
  // linear, and so are the particles' velocities.
  for (const Method& method : methods) {
    CAPTURE(method.name);
    MpmScene scene;
    scene.pace = "courant = 0.02";
    scene.tables = body("block", box({0.0, 0.0}, {4.0, 4.0}), "particles_per_cell = 4") +
                   driven("[-inf, -inf]", "[2, inf]", "\"x\", \"y\"", {0.0, 0.01}) +
                   driven("[3, -inf]", "[inf, inf]", "\"x\", \"y\"", {0.0, 0.03});
    MpmRun run(with_method(scene, method));
    run.advance(5.0);
    const Particles& p = run.particles();
    for (std::size_t i = 0; i < p.size; ++i)
      CHECK(p.velocity[1][i] ==
            Approx(0.01 + 0.02 * std::clamp(p.position[0][i] - 2.0, 0.0, 1.0)).epsilon(1e-9));
    CHECK(std::abs(run.energy().relative_residual()) < 0.01);
  }
}

TEST_CASE("Moving boxes that hold the same nodes at different velocities end the run, or have an order",
          "[verification][mpm][boundaries]") {
  // Each has gone more than half a cell, and so holds one row more: they share it before they have met.
  for (const Method& method : methods)
    for (const bool ordered : {false, true}) {
      CAPTURE(method.name, ordered);
      MpmScene scene;
      scene.pace = "courant = 0.05";
      scene.tables = body("block", box({0.0, 0.0}, {4.0, 4.0}), "particles_per_cell = 4") +
                     driven("[-inf, -1000]", "[inf, 1]", "\"y\"", {0.0, 0.55}, "name = \"lower\"") +
                     driven("[-inf, 3]", "[inf, 1000]", "\"y\"", {0.0, -0.55},
                            ordered ? "name = \"upper\"\npriority = 1" : "name = \"upper\"") +
                     hold_everywhere("x");
      MpmRun run(with_method(scene, method));
      const auto advance = [&] { run.advance(1.0); };
      if (ordered) {
        CHECK_NOTHROW(advance());
        continue;
      }
      try {
        advance();
        FAIL("two boundaries hold the same nodes at different velocities");
      } catch (const ComputationError& error) {
        CHECK(std::string(error.what()).find("boundaries 'lower' and 'upper' have met") != std::string::npos);
      }
      CHECK(run.system.time > 0.9);
    }
}

TEST_CASE("Moving boxes do not depend on the number of threads", "[verification][mpm][boundaries]") {
  for (const char* shape : {"linear", "bspline2"})
    for (const Method& method : methods) {
      CAPTURE(shape, method.name);
      MpmRun one(with_method(press(shape, 0.1, false), method), 1),
          three(with_method(press(shape, 0.1, false), method), 3);
      one.advance(6.0), three.advance(6.0);
      CHECK(one.particles().position[1] == three.particles().position[1]);
      CHECK(one.particles().velocity[1] == three.particles().velocity[1]);
      CHECK(one.energy().external == three.energy().external);
    }
}
