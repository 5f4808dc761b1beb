#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "mpm/stress.hpp"
#include "support/mpm_measure.hpp"
#include "support/mpm_run.hpp"

using namespace vitrum;
using namespace vitrum::test;

// A bar in uniaxial strain (all y held) runs into a wall at x = 0: behind a front that travels at c =
// sqrt(M/rho) the stress is -rho c v. Reference values are of a real material, so that no unit factor hides.

namespace {

constexpr double density = 2500.0, young = 72.0e9, poisson = 0.25, cell = 1.0e-3;
// Slow enough that no particle leaves its cell: at 10 m/s those 200 cells away would move by a third of one.
constexpr double speed = 1.0;
constexpr int cells = 300;

MpmScene bar_on_wall(const std::string& shape, const std::string& scheme, int particles_per_cell,
                     double speed_at_wall, double speed_of_bar) {
  MpmScene scene;
  scene.cell = cell, scene.shape = shape, scene.scheme = scheme, scene.pace = "courant = 0.3";
  scene.density = density, scene.young = young, scene.poisson = poisson;
  scene.tables =
      hold_everywhere("y") + hold("[-inf, -inf]", "[0, inf]", R"("x", "y")", {speed_at_wall, 0.0}) +
      body("bar", box({0.0, 0.0}, {cells * cell, cell}),
           fmt::format("particles_per_cell = {}\nvelocity = [{}, 0.0]", particles_per_cell, speed_of_bar));
  return scene;
}

/// Mean axial stress of the particles between two positions, by mass.
double mean_stress(const Body& body, double from, double to) {
  const Particles& p = body.particles;
  const auto stress = mpm::stress_of(body);
  double sum = 0.0, mass = 0.0;
  for (std::size_t i = 0; i < p.size; ++i)
    if (p.position[0][i] >= from && p.position[0][i] < to) sum += p.mass[i] * stress[0][i], mass += p.mass[i];
  return sum / mass;
}

/// Where the stress last passes half of `plateau` going away from the wall, linear between particles.
double front(const Body& body, double plateau) {
  const Particles& p = body.particles;
  const auto stress = mpm::stress_of(body);
  std::vector<std::pair<double, double>> row;
  const double z = p.position[1][0];
  for (std::size_t i = 0; i < p.size; ++i)
    if (p.position[1][i] == z) row.emplace_back(p.position[0][i], stress[0][i]);
  std::sort(row.begin(), row.end());
  for (std::size_t i = row.size() - 1; i > 0; --i)
    if (row[i - 1].second / plateau > 0.5) {
      const auto [x0, s0] = row[i - 1];
      const auto [x1, s1] = row[i];
      return x0 + (x1 - x0) * (0.5 * plateau - s0) / (s1 - s0);
    }
  return 0.0;
}

}  // namespace

TEST_CASE("Uniaxial strain wave: speed and amplitude rho c v within 1 %", "[verification][mpm]") {
  const double modulus = young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
  const double c = std::sqrt(modulus / density), plateau = -density * c * speed;
  for (const char* shape : {"linear", "gimp"})
    for (const char* scheme : {"usf", "usl", "musl"})
      for (const int ppc : {1, 4}) {
        CAPTURE(shape, scheme, ppc);
        MpmRun run(bar_on_wall(shape, scheme, ppc, 0.0, -speed));
        const double early = 100.0 * cell / c, late = 250.0 * cell / c;
        run.advance(early);
        const double first = front(run.system.bodies[0], plateau);
        run.advance(late);
        const double second = front(run.system.bodies[0], plateau);
        const double amplitude_error =
            mean_stress(run.system.bodies[0], 20.0 * cell, 220.0 * cell) / plateau - 1.0;
        const double speed_error = (second - first) / (late - early) / c - 1.0;
        CAPTURE(amplitude_error, speed_error);
        CHECK(std::abs(amplitude_error) < 0.01);
        CHECK(std::abs(speed_error) < 0.01);
      }
}

TEST_CASE(
    "A piston's wave: the work of a prescribed velocity is rho c v^2 per time, and all of it is found again",
    "[verification][mpm]") {
  const double modulus = young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
  const double c = std::sqrt(modulus / density);
  // The wall moves: its nodes drive the bar, which stays well within its first cell (0.04 cells of travel).
  for (const char* scheme : {"usf", "usl", "musl"}) {
    CAPTURE(scheme);
    MpmRun run(bar_on_wall("linear", scheme, 1, 1.0, 0.0));
    const double time = 200.0 * cell / c;
    run.advance(time);
    const double work_error = run.energy().external / (density * c * 1.0 * 1.0 * time * cell) - 1.0;
    const double residual = run.energy().relative_residual();
    CAPTURE(work_error, residual);
    CHECK(std::abs(work_error) < 0.01);
    CHECK(std::abs(residual) < 0.02);
  }
}
