#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "catch.hpp"
#include "support/mpm_run.hpp"

using namespace vitrum;
using namespace vitrum::test;

// A thin rod (Poisson's ratio 0: c = sqrt(E/rho)) runs into a wall that is a plane of symmetry. A stress wave
// brings it to rest in L/c and gives it its speed back in another L/c; since the plane holds both ways this
// repeats: the kinetic energy is a triangle of period 2 L/c.
TEST_CASE("A thin rod against a symmetry-plane wall: its kinetic energy is a triangle",
          "[verification][mpm]") {
  constexpr int cells = 200;
  constexpr double length = cells, speed = 1e-4;
  for (const char* shape : {"linear", "gimp"})
    for (const char* scheme : {"usf", "usl", "musl"}) {
      CAPTURE(shape, scheme);
      MpmScene scene;
      scene.shape = shape, scene.scheme = scheme, scene.pace = "courant = 0.3";
      scene.young = 1.0, scene.poisson = 0.0;
      scene.tables = body("rod", box({0.0, 0.0}, {length, 2.0}), "velocity = [-1e-4, 0.0]") +
                     hold("[-inf, -inf]", "[0, inf]", "\"x\"");
      MpmRun run(scene);
      const double initial = run.energy().initial;
      CHECK(initial == Approx(0.5 * 2.0 * length * speed * speed));
      double worst = 0.0, least = 1.0;
      run.watch = [&](double) {
        const double t = run.system.time / length, expected = std::abs(1.0 - std::fmod(t, 2.0));
        const double kinetic = run.system.record.kinetic / initial;
        worst = std::max(worst, std::abs(kinetic - expected));
        least = std::min(least, kinetic);
        return true;
      };
      run.advance(2.0 * length);
      const double rebound = mass_mean(run.particles(), run.particles().velocity[0]) / speed;
      run.advance(4.0 * length);
      CAPTURE(worst, least, rebound);
      CHECK(worst < 0.03);
      CHECK(least < 0.02);
      CHECK(rebound == Approx(1.0).epsilon(0.02));
      CHECK(std::abs(run.energy().relative_residual()) < 0.05);
    }
}

// A wall is nodes that are held, which hold what comes within reach. So what falls on them must reach and
// leave them at places that are told apart to hundredths of a cell, or it stays welded: with phases a quarter
// of a cell long the rod was left with half its speed or swung on the wall.
TEST_CASE("A rod that falls on held nodes leaves them with its speed, free of stress",
          "[verification][mpm]") {
  constexpr double length = 16.0, speed = 2e-3;
  const std::pair<const char*, const char*> methods[] = {
      {"usf", "courant = 0.2"}, {"musl", "courant = 0.2"}, {"arkode-explicit", ""}, {"arkode-implicit", ""}};
  for (const auto& [method, pace] : methods)
    for (const char* shape : {"gimp", "bspline2"})
      for (const double gap : {1.3, 1.55}) {
        CAPTURE(method, shape, gap);
        MpmScene scene;
        const bool adaptive = std::string(method).starts_with("arkode");
        scene.shape = shape, scene.pace = pace;
        (adaptive ? scene.method : scene.scheme) = method;
        scene.young = 1.0, scene.poisson = 0.0;
        scene.tables = body("rod", box({0.0, gap}, {2.0, gap + length}),
                            "particles_per_cell = 4\nvelocity = [0.0, -2e-3]") +
                       hold("[-inf, -inf]", "[inf, 0.0]", "\"y\"");
        MpmRun run(scene);
        double least = 1.0;
        run.watch = [&](double) {
          least = std::min(least, run.system.record.kinetic / run.energy().initial);
          return true;
        };
        run.advance(0.6 / speed + 2.0 * length + 1.0 / speed);
        const double rebound = mass_mean(run.particles(), run.particles().velocity[1]) / speed;
        const double stored = run.energy().elastic / run.energy().initial;
        CAPTURE(least, rebound, stored);
        CHECK(least < 0.1);  // it was stopped
        CHECK(rebound == Approx(1.0).margin(0.01));
        CHECK(stored < 0.03);
      }
}

// A die that moves at 5 mm/s presses a block against a table whose hold it has come to: phases there end by
// the way that nodes go, which is next to none, not by what strain could give.
TEST_CASE("A slow press near held nodes takes few steps", "[verification][mpm]") {
  for (const auto& [shape, most] : {std::pair("gimp", 1300), std::pair("bspline2", 250)}) {
    CAPTURE(shape);
    MpmScene scene;
    scene.method = "arkode-implicit", scene.shape = shape, scene.pace = "", scene.cell = 1e-3;
    scene.density = 2500.0, scene.young = 72e9;
    scene.tables = body("block", box({0.0, 0.8e-3}, {5e-3, 10e-3}), "particles_per_cell = 4") +
                   hold("[-inf, -inf]", "[inf, 0.0]", "\"y\"") +
                   hold("[-inf, 0.01]", "[inf, inf]", "\"y\"", {0.0, -5e-3});
    MpmRun run(scene);
    int steps = 0;
    run.watch = [&](double) { return ++steps < 20 * most; };
    for (const double output : {1e-3, 2e-3, 3e-3, 4e-3, 5e-3}) run.advance(output);  // each begins a phase
    CHECK(steps < most);
    CHECK(run.energy().elastic == Approx(6.2).margin(0.6));  // J/m: it was pressed
  }
}

// What moves with a wall goes no way that matters at it: 29 phases, or 61 if ways were absolute.
TEST_CASE("What moves with a wall that draws away ends few phases", "[verification][mpm]") {
  MpmScene scene;
  scene.method = "arkode-implicit", scene.shape = "gimp", scene.pace = "", scene.cell = 1e-3;
  scene.density = 2500.0, scene.young = 72e9, scene.poisson = 0.0;
  scene.tables =
      body("rod", box({0.0, 2e-3}, {4e-3, 52e-3}), "particles_per_cell = 4\nvelocity = [0.0, -60.0]") +
      hold("[-1, -1]", "[1, 0.0]", "\"y\"", {0.0, -50.0});
  MpmRun run(scene);
  int phases = 0;
  run.watch = [&](double) {
    phases += run.system.record.particles_moved;
    return true;
  };
  run.advance(100e-6);
  CAPTURE(phases);
  CHECK(phases < 45);
}
