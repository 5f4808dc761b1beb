#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "mpm/stress.hpp"
#include "support/mpm_run.hpp"

using namespace vitrum;
using namespace vitrum::test;

// Two elastic disks that meet head-on along the diagonal of a unit square (Sulsky, Chen, Schreyer 1994).

namespace {

constexpr double cell = 0.05, radius = 0.2, speed = 0.1;

MpmScene disks(const std::string& shape, const std::string& scheme, double courant = 0.2) {
  MpmScene scene;
  scene.cell = cell, scene.shape = shape, scene.scheme = scheme, scene.pace = "courant = " + number(courant);
  scene.density = 1000.0, scene.young = 1000.0, scene.poisson = 0.3;
  const std::string toward = pair({speed, speed}), back = pair({-speed, -speed});
  scene.tables = body("left", disk({0.2, 0.2}, radius), "particles_per_cell = 4\nvelocity = " + toward) +
                 body("right", disk({0.8, 0.8}, radius), "particles_per_cell = 4\nvelocity = " + back);
  return scene;
}

double largest_stress(const System& system) {
  double largest = 0.0;
  for (const Body& b : system.bodies)
    for (const std::vector<double>& component : mpm::stress_of(b))
      for (const double s : component) largest = std::max(largest, std::abs(s));
  return largest;
}

}  // namespace

TEST_CASE("Two elastic disks collide and part again", "[verification][mpm]") {
  for (const char* shape : {"linear", "gimp", "bspline2"})
    for (const char* scheme : {"usf", "musl"}) {
      CAPTURE(shape, scheme);
      MpmRun run(disks(shape, scheme));
      double first_stress = 0.0, largest_momentum = 0.0, least_kinetic = run.energy().initial;
      run.watch = [&](double) {
        if (first_stress == 0.0 && largest_stress(run.system) > 1e-9) first_stress = run.system.time;
        const auto p = total_momentum(run.system);
        largest_momentum = std::max({largest_momentum, std::abs(p[0]), std::abs(p[1])});
        least_kinetic = std::min(least_kinetic, run.system.record.kinetic);
        return true;
      };
      run.advance(3.5);
      const EnergyTotals& e = run.energy();
      const double mass_speed = mass_mean(run.particles(0), run.particles(0).velocity[0]);
      const double restitution = -mass_speed / speed, growth = e.max_growth - 1.0;
      const double least = least_kinetic / e.initial, residual = e.relative_residual();
      CAPTURE(first_stress, restitution, growth, least, residual);

      const double gap = 0.6 * std::sqrt(2.0) - 2.0 * radius, closing = 2.0 * speed * std::sqrt(2.0);
      // Particles feel each other through common nodes: up to two cell diagonals (splines: three) before they
      // touch.
      const double reach = (std::string(shape) == "linear" ? 2.0 : 3.0) * cell * std::sqrt(2.0);
      CHECK(first_stress < gap / closing);
      CHECK(first_stress > (gap - reach) / closing);
      const double momentum_of_one = speed * 1000.0 * 3.14 * radius * radius;
      CHECK(largest_momentum < 1e-13 * momentum_of_one);
      CHECK(least < 0.6);
      CHECK(restitution > 0.7);
      CHECK(restitution < 1.0);
      CHECK(growth < 0.02);
      CHECK(std::abs(residual) < 0.05);
      // The scene is its own image under a half turn about (0.5, 0.5).
      const Particles &left = run.particles(0), &right = run.particles(1);
      REQUIRE(left.size == right.size);
      for (std::size_t i = 0; i < left.size; ++i)
        for (std::size_t k = 0; k < 2; ++k)
          REQUIRE(left.position[k][i] + right.position[k][left.size - 1 - i] == Approx(1.0).margin(1e-9));
    }
}

TEST_CASE("What the collision of two disks makes of energy falls with the step", "[verification][mpm]") {
  const auto growth = [](double courant) {
    MpmRun run(disks("linear", "usf", courant));
    run.advance(2.0);
    return run.energy().max_growth - 1.0;
  };
  const double coarse = growth(0.2), fine = growth(0.1), finest = growth(0.05);
  CAPTURE(coarse, fine, finest);
  CHECK(fine < 0.6 * coarse);
  CHECK(finest < 0.6 * fine);
}
