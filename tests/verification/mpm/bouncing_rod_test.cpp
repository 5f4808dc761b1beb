#include <algorithm>
#include <cmath>

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
