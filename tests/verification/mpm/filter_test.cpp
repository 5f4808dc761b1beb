#include "mpm/filter.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "mpm/cell_average.hpp"
#include "mpm/stress.hpp"
#include "support/mpm_run.hpp"
#include "support/random_states.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

/// A metal ball of six cells in diameter that flattens on a wall at 300 m/s, and rests or flies back.
std::string ball(const std::string& shape, int per_cell, const std::string& filter,
                 const std::string& integrator = "method = \"explicit\"\nscheme = \"musl\"") {
  return fmt::format(
      "[space]\ngeometry = \"axisymmetric\"\ncell = 0.5e-3\nshape_functions = \"{}\"\nfilter = \"{}\"\n"
      "[time]\nend = 15e-6\n[integrator]\n{}\n"
      "[material.m]\ndensity = 2700\nyoung = 70e9\npoisson = 0.33\n"
      "[material.m.von_mises]\nyield = 300e6\npeak = 300e6\nhardening = 0\nsoftening = 0\n"
      "[[body]]\nname = \"ball\"\nmaterial = \"m\"\ndisk = {{centre = [0, 0.00155], radius = 0.0015}}\n"
      "particles_per_cell = {}\nvelocity = [0, -300]\n"
      "[[boundary]]\nbox = {{min = [-1, -1], max = [1, 0]}}\nfix = [\"z\"]\n",
      shape, filter, integrator, per_cell);
}

double largest_pressure(const Body& body) {
  const TensorColumns stress = mpm::stress_of(body);
  double largest = 0.0;
  for (std::size_t i = 0; i < body.particles.size; ++i)
    largest = std::max(largest, std::abs(stress[0][i] + stress[1][i] + stress[2][i]) / 3.0);
  return largest;
}

}  // namespace

TEST_CASE("What differs within a cell: uniform pressures keep, sums keep, energy falls", "[mpm][filter]") {
  MpmRun run(parse_scene(ball("gimp", 4, "none"), "ball.toml"));
  const Body& body = run.system.bodies[0];
  const std::size_t size = body.particles.size;
  const mpm::CellAverage average(*run.system.team, body, run.system.cell, std::vector<char>(size, 1));
  for (const double d : average.differences(std::vector<double>(size, 3.0), 4)) CHECK(std::abs(d) < 1e-13);
  Random random(1);
  for (int n = 0; n < 20; ++n) {
    std::vector<double> q(size);
    for (double& v : q) v = random.uniform(-1.0, 1.0);
    const std::vector<double> d = average.differences(q, 4);
    double sum = 0.0, before = 0.0, after = 0.0;
    for (std::size_t i = 0; i < size; ++i) {
      const double volume = body.particles.mass[i];
      sum += volume * d[i], before += volume * q[i] * q[i], after += volume * (q[i] - d[i]) * (q[i] - d[i]);
    }
    CHECK(std::abs(sum) < 1e-12 * before);
    CHECK(after < 0.9 * before);
  }
}

TEST_CASE("Particles that take no part neither give nor get", "[mpm][filter]") {
  MpmRun run(parse_scene(ball("gimp", 4, "none"), "ball.toml"));
  const Body& body = run.system.bodies[0];
  std::vector<char> counted(body.particles.size, 1);
  std::vector<double> q(body.particles.size, 1.0);
  for (std::size_t i = 0; i < q.size(); i += 3) counted[i] = 0, q[i] = 100.0;
  for (const double d : mpm::CellAverage(*run.system.team, body, run.system.cell, counted).differences(q, 2))
    CHECK(std::abs(d) < 1e-13);
}

TEST_CASE("A ball that has flattened on a wall stores no pressures against itself under the filter",
          "[verification][mpm][filter]") {
  // rho c v of the impact, the most that a one-dimensional front bears.
  const double bound = 2700.0 * std::sqrt(70e9 / (3.0 * (1.0 - 0.66)) / 2700.0 * 1.5) * 300.0;
  for (const char* shape : {"linear", "gimp", "bspline2"})
    for (const int per_cell : {1, 4, 9}) {
      CAPTURE(shape, per_cell);
      MpmRun run(parse_scene(ball(shape, per_cell, "pressures"), "ball.toml"));
      run.advance(15e-6);
      CHECK(mpm::ringing_energy(run.system) < 0.02 * run.energy().initial);
      CHECK(largest_pressure(run.system.bodies[0]) < bound);
      CHECK(run.energy().filtered >= 0.0);
    }
}

TEST_CASE("The filter acts alike in every integrator, and its account closes",
          "[verification][mpm][filter]") {
  const auto ringing_of = [](const std::string& filter, const std::string& integrator) {
    MpmRun run(parse_scene(ball("gimp", 4, filter, integrator), "ball.toml"));
    run.advance(15e-6);
    const EnergyTotals& energy = run.energy();
    CHECK((energy.filtered > 0.0) == (filter == "pressures"));
    if (integrator.find("implicit") == std::string::npos) CHECK(std::abs(energy.relative_residual()) < 0.05);
    return mpm::ringing_energy(run.system) / energy.initial;
  };
  for (const char* integrator :
       {"method = \"explicit\"\nscheme = \"usf\"", "method = \"explicit\"\nscheme = \"musl\"",
        "method = \"arkode-explicit\"\nrtol = 1e-2", "method = \"arkode-implicit\"\nrtol = 1e-2"}) {
    CAPTURE(integrator);
    const double without = ringing_of("none", integrator), with = ringing_of("pressures", integrator);
    CHECK(without > 0.02);
    CHECK(with < 0.1 * without);
  }
}

TEST_CASE("The filter leaves what many cells share: a rod that swings", "[verification][mpm][filter]") {
  MpmRun run(parse_scene(
      "[space]\ngeometry = \"axisymmetric\"\ncell = 0.5e-3\nfilter = \"pressures\"\n[time]\nend = 150e-6\n"
      "[integrator]\nmethod = \"explicit\"\n[material.m]\ndensity = 7800\nyoung = 195e9\npoisson = 0.25\n"
      "[[body]]\nname = \"rod\"\nmaterial = \"m\"\nbox = {min = [0, 0], max = [0.002, 0.02]}\n"
      "particles_per_cell = 4\nvelocity = [0, -10]\nvelocity_gradient = [[0, 0], [0, 1000]]\n",
      "rod.toml"));
  run.advance(150e-6);  // some twenty swings
  CHECK(run.energy().filtered < 0.03 * run.energy().initial);
}
