#include "mpm/coasting.hpp"

#include <cmath>

#include "catch.hpp"
#include "support/mpm_run.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

MpmScene collision(const std::string& geometry, const std::string& shape, const std::string& scheme) {
  MpmScene scene;
  scene.geometry = geometry, scene.shape = shape, scene.scheme = scheme;
  scene.tables = body("block", box({0.0, 0.0}, {6.0, 3.0}), "particles_per_cell = 4") +
                 body("ball", disk({0.0, 9.0}, 2.0), "particles_per_cell = 4\nvelocity = [0.0, -0.25]");
  return scene;
}

bool coasts(const MpmRun& run, std::size_t body) {
  return run.system.bodies[body].coasting.has_value();
}

}  // namespace

TEST_CASE("A collision is the same whether or not bodies coast before it", "[mpm]") {
  for (const char* geometry : {"plane-strain", "axisymmetric"})
    for (const char* shape : {"linear", "gimp", "bspline2"})
      for (const char* scheme : {"usf", "musl"}) {
        CAPTURE(geometry, shape, scheme);
        MpmRun coasting(collision(geometry, shape, scheme)), awake(collision(geometry, shape, scheme));
        awake.system.coasting_settled = true;
        coasting.advance(1.0), awake.advance(1.0);
        REQUIRE(coasts(coasting, 0));
        REQUIRE(coasts(coasting, 1));
        REQUIRE_FALSE(coasts(awake, 0));
        REQUIRE(coasting.energy().kinetic == Approx(awake.energy().kinetic).epsilon(1e-14));
        coasting.advance(30.0), awake.advance(30.0);
        CHECK_FALSE(coasts(coasting, 0));
        CHECK_FALSE(coasts(coasting, 1));
        CHECK(coasting.energy().elastic > 1e-3 * coasting.energy().initial);
        for (std::size_t n = 0; n < 2; ++n) {
          // (In the order of seeding: storage differs.)
          const Particles &a = coasting.particles(n), &b = awake.particles(n);
          std::vector<std::size_t> place(b.size);
          for (std::size_t i = 0; i < b.size; ++i) place[b.identity[i]] = i;
          for (std::size_t i = 0; i < a.size; ++i)
            for (std::size_t k = 0; k < 2; ++k) {
              const std::size_t j = place[a.identity[i]];
              REQUIRE(a.position[k][i] == Approx(b.position[k][j]).margin(1e-10));
              REQUIRE(a.velocity[k][i] == Approx(b.velocity[k][j]).margin(1e-10));
            }
        }
      }
}

TEST_CASE("A body that coasts wakes at a wall, at another body, and not at one that flies beside it",
          "[mpm]") {
  MpmScene scene;
  scene.tables = body("first", box({0.0, 0.0}, {3.0, 3.0}), "velocity = [0.0, -0.5]") +
                 body("beside", box({3.0, 0.0}, {6.0, 3.0}), "velocity = [0.0, -0.5]") +
                 body("still", box({20.0, 0.0}, {23.0, 3.0})) +
                 hold("[-1.0, -5.0]", "[10.0, -4.0]", "\"y\"") +
                 hold("[19.0, 0.0]", "[30.0, 0.0]", "\"x\", \"y\"");
  MpmRun run(scene);
  run.advance(2.0);
  for (const std::size_t n : {0U, 1U, 2U}) CHECK(coasts(run, n));  // the wall that holds what rests is none
  run.advance(20.0);
  CHECK_FALSE(coasts(run, 0));
  CHECK_FALSE(coasts(run, 1));
  CHECK(coasts(run, 2));
  for (const double y : run.particles(0).position[1]) CHECK(y > -5.0);
}

TEST_CASE("Bodies that are strained, move differently within, or fall do not coast", "[mpm]") {
  const std::string block = box({0.0, 0.0}, {3.0, 3.0});
  for (const std::string& tables : {body("b", block, "velocity_gradient = [[1e-3, 0.0], [0.0, 0.0]]"),
                                    body("b", block, "stress = [1.0, 0.0, 0.0, 0.0]"),
                                    body("b", block) + "[gravity]\nacceleration = [0.0, -1.0]\n"}) {
    MpmScene scene;
    scene.tables = tables;
    MpmRun run(scene);
    run.advance(0.5);
    CHECK_FALSE(coasts(run, 0));
  }
  MpmScene outwards;
  outwards.geometry = "axisymmetric", outwards.tables = body("b", block, "velocity = [0.1, 0.0]");
  MpmRun run(outwards);
  run.advance(0.5);
  CHECK_FALSE(coasts(run, 0));
}

TEST_CASE("When a body wakes does not depend on how lists of particles came about", "[mpm]") {
  // Two bodies on the grid drift ahead of a third, away from cells that their blocks were once made for.
  MpmScene scene;
  scene.tables =
      body("first", box({0.0, 0.0}, {3.0, 3.0}), "particles_per_cell = 4\nvelocity = [0.1, 0.0]") +
      body("second", box({3.0, 0.0}, {6.0, 3.0}), "particles_per_cell = 4\nvelocity = [0.1001, 0.0]") +
      body("chaser", box({-28.0, 0.0}, {-25.0, 3.0}), "particles_per_cell = 4\nvelocity = [0.6, 0.0]");
  MpmRun amended(scene), anew(scene);
  std::int64_t woken[2] = {0, 0};
  MpmRun* const runs[2] = {&amended, &anew};
  for (std::size_t n = 0; n < 2; ++n) {
    MpmRun& run = *runs[n];
    run.watch = [&run, &woken, n](double) {
      if (n == 1) run.system.grid_is_stale = true;  // as after resuming
      if (woken[n] == 0 && !coasts(run, 2)) woken[n] = run.system.step_index;
      return woken[n] == 0;
    };
    run.advance(100.0);
  }
  CHECK(woken[0] > 10);
  CHECK(woken[0] == woken[1]);
}
