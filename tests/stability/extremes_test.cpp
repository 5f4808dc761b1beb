#include <cmath>
#include <limits>

#include "app/watchdog.hpp"
#include "catch.hpp"
#include "mpm/computation_error.hpp"
#include "support/mpm_run.hpp"

using namespace vitrum;
using namespace vitrum::test;

TEST_CASE("A step three times the critical one is stopped by its growth, with a message that says what to do",
          "[stability]") {
  for (const char* scheme : {"usf", "usl", "musl"}) {
    CAPTURE(scheme);
    MpmScene scene;
    scene.scheme = scheme;
    scene.tables = body("ball", disk({0.0, 0.0}, 6.0), "velocity_gradient = [[1e-3, 0.0], [0.0, -1e-3]]");
    const StepScheme kind = parse_scene(scene.text(), "test").integrator.scheme;
    scene.pace = fixed_step(3.0 * stability_limit(kind));
    MpmRun run(scene);
    const app::Watchdog watchdog(1.5, run.integrator);
    std::optional<std::string> message;
    run.watch = [&](double step) {
      message = watchdog.look(run.system, run.ledger, step);
      return !message;
    };
    run.advance(1000.0);
    REQUIRE(message);
    CAPTURE(*message, run.system.step_index);
    CHECK(run.system.step_index < 100);
    CHECK(message->find("body 'ball'") != std::string::npos);
    CHECK(message->find("3 times the critical step") != std::string::npos);
    CHECK(message->find("integrator.step") != std::string::npos);
    // With no bound on growth only values that are not finite stop a run.
    CHECK_FALSE(app::Watchdog(std::numeric_limits<double>::infinity(), run.integrator)
                    .look(run.system, run.ledger, 1.0));
  }
}

TEST_CASE(
    "Positions that are not finite or beyond all grids end in a ComputationError that names the particle",
    "[stability]") {
  for (const double position :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -1e300, 3e9}) {
    CAPTURE(position);
    MpmScene scene;
    scene.tables = body("block", box({0.0, 0.0}, {3.0, 3.0}));
    MpmRun run(scene);
    run.particles().position[1][5] = position;
    try {
      run.advance(1.0);
      FAIL("no error");
    } catch (const ComputationError& error) {
      CHECK(std::string(error.what()).find("body 'block', particle 5") != std::string::npos);
    }
  }
}

TEST_CASE("A velocity that is not finite is seen: by the energy at once, by the grid at the next step",
          "[stability]") {
  MpmScene scene;
  scene.pace = fixed_step(0.1);
  scene.tables = body("block", box({0.0, 0.0}, {3.0, 3.0}));
  MpmRun run(scene);
  run.particles().velocity[0][4] = std::numeric_limits<double>::quiet_NaN();
  const app::Watchdog watchdog(std::numeric_limits<double>::infinity(), run.integrator);
  bool seen = false;
  run.watch = [&](double step) {
    seen = watchdog.look(run.system, run.ledger, step).has_value();
    return false;
  };
  run.advance(1.0);
  CHECK(seen);
  CHECK(std::isnan(run.system.record.kinetic));
  run.watch = nullptr;
  CHECK_THROWS_AS(run.advance(1.0), ComputationError);
}

TEST_CASE(
    "A one-particle body flies straight from anywhere: on a node, an edge, one rounding beside, and on the "
    "axis",
    "[stability]") {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (const char* geometry : {"plane-strain", "axisymmetric"})
    for (const char* shape : {"linear", "gimp", "bspline2"})
      for (const char* scheme : {"usf", "musl"})
        for (const double at : {0.0, std::nextafter(0.0, 1.0), 1e-300, 1.0, std::nextafter(1.0, 0.0),
                                std::nextafter(1.0, infinite), 0.5, 8.0, std::nextafter(8.0, 0.0), 7.5}) {
          CAPTURE(geometry, shape, scheme, at);
          MpmScene scene;
          scene.geometry = geometry, scene.shape = shape, scene.scheme = scheme,
          scene.pace = fixed_step(0.25);
          scene.tables = body("grain", box({0.0, 0.0}, {1.0, 1.0}), "velocity = [0.0, -0.5]");
          MpmRun run(scene);
          Particles& p = run.particles();
          p.position = {std::vector<double>{at}, std::vector<double>{at}};
          run.advance(4.0);
          REQUIRE(std::abs(p.position[1][0] - (at - 2.0)) < 1e-13);
          REQUIRE(std::abs(p.position[0][0] - at) < 1e-13);
          REQUIRE(std::abs(p.velocity[1][0] + 0.5) < 1e-13);
          for (const auto& e : p.elastic_strain) REQUIRE(std::abs(e[0]) < 1e-13);
        }
}

TEST_CASE("Coincident particles and a body far from the others are no trouble", "[stability]") {
  MpmScene scene;
  scene.tables = body("block", box({0.0, 0.0}, {3.0, 3.0}), "velocity = [0.0, 0.1]") +
                 body("far", box({1e9, -1e9}, {1e9 + 1.0, 1.0 - 1e9}), "velocity = [0.0, 0.1]");
  MpmRun run(scene);
  Particles& p = run.particles();
  p.position[0][1] = p.position[0][0], p.position[1][1] = p.position[1][0];
  run.advance(5.0);
  CHECK(run.energy().max_growth < 1.0 + 1e-12);
  CHECK(run.system.bodies[1].particles.position[1][0] == Approx(0.5 - 1e9 + 0.5).epsilon(1e-15));
}
