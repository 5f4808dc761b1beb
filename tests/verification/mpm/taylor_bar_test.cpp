#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "support/mpm_run.hpp"

using namespace vitrum;
using namespace vitrum::test;

// The copper bar of Taylor's test as finite-element codes are compared on it: 32.4 mm long, radius 3.2 mm,
// 227 m/s against a frictionless wall, E = 117 GPa, nu = 0.35, yield 400 MPa, tangent modulus 100 MPa. After
// 80 us published computations give a length of 21.3 to 21.5 mm and a foot radius of 6.9 to 7.3 mm. The
// strength of eq. 24 grows with I, the integral of |d eps_p|, which is sqrt(3/2) times the usual equivalent
// plastic strain of the same flow: the modulus over I is 100 MPa / sqrt(3/2) = 81.65 MPa.

namespace {

constexpr double cell = 0.4e-3, length = 32.4e-3, radius = 3.2e-3;

MpmScene bar(const std::string& shape, const std::string& scheme) {
  MpmScene scene;
  scene.geometry = "axisymmetric", scene.cell = cell, scene.shape = shape, scene.scheme = scheme,
  scene.pace = "courant = 0.4";
  scene.density = 8930.0, scene.young = 117.0e9, scene.poisson = 0.35;
  scene.tables =
      body("bar", box({0.0, 0.0}, {radius, length}), "particles_per_cell = 4\nvelocity = [0.0, -227.0]") +
      hold("[-inf, -inf]", "[inf, 0]", "\"z\"") +
      "[material.elastic.von_mises]\nyield = 400e6\npeak = 4e9\nhardening = 81.65e6\nsoftening = 0.0\n";
  return scene;
}

}  // namespace

TEST_CASE("Taylor bar: length, foot radius and volume", "[verification][mpm]") {
  struct Case {
    const char *shape, *scheme;
  };
  // The wall is a plane of symmetry for functions that reach beyond it, too.
  for (const auto& [shape, scheme] :
       {Case{"linear", "usf"}, Case{"linear", "musl"}, Case{"gimp", "musl"}, Case{"bspline2", "usf"}}) {
    MpmRun run(bar(shape, scheme));
    const Particles& p = run.particles();
    double initial_volume = 0.0;
    for (std::size_t i = 0; i < p.size; ++i) initial_volume += p.mass[i] / 8930.0;
    run.advance(80e-6);
    double top = 0.0, foot = 0.0, lowest = 1.0, volume = 0.0, largest_strain = 0.0;
    const auto& plastic = run.system.bodies[0].column("plastic_strain");
    for (std::size_t i = 0; i < p.size; ++i) {
      top = std::max(top, p.position[1][i]);
      lowest = std::min(lowest, p.position[1][i]);
      foot = std::max(foot, p.position[0][i]);
      volume += p.mass[i] / 8930.0 *
                std::exp(p.elastic_strain[0][i] + p.elastic_strain[1][i] + p.elastic_strain[2][i]);
      largest_strain = std::max(largest_strain, plastic[i]);
    }
    // Particles are centres of their material.
    const double final_length = top + 0.25 * cell, foot_radius = foot + 0.25 * cell;
    const double kinetic = run.energy().kinetic / run.energy().initial,
                 residual = run.energy().relative_residual();
    CAPTURE(shape, scheme, final_length, foot_radius, lowest, largest_strain, volume / initial_volume,
            kinetic, residual);
    CHECK(final_length == Approx(21.4e-3).margin(0.4e-3));
    CHECK(foot_radius == Approx(7.1e-3).margin(0.4e-3));
    CHECK(lowest > 0.0);  // none crosses the wall
    CHECK(volume == Approx(initial_volume).epsilon(0.002));
    CHECK(kinetic < 0.01);
    CHECK(std::abs(residual) < 0.05);
    CHECK(run.energy().plastic > 0.9 * run.energy().initial);
  }
}
