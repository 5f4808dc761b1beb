#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "support/mpm_measure.hpp"
#include "support/mpm_run.hpp"

using namespace vitrum;
using namespace vitrum::test;

// Plane standing waves of wavelength 2 L in both directions, started by their velocity: exact for all times
// in an infinite body. The body is a block of side 4 L, and errors are measured in the middle square of side
// L before its edges are heard.
//   pressure: v = (sin kx cos ky, cos kx sin ky) cos wt, w = sqrt(2) k c_p
//   shear:    v = (sin kx cos ky, -cos kx sin ky) cos wt, w = sqrt(2) k c_s

namespace {

struct Wave {
  const char* name;
  double sign, speed;
};
const Wave pressure{"pressure", 1.0, 1.0}, shear{"shear", -1.0, std::sqrt(unit_shear)};

/// Relative RMS error of velocities and positions' displacement after 0.35 of a period, with n cells per L.
/// The step shrinks as the square of the cell: what is left is the error of the discretisation in space.
double error(const Wave& wave, const std::string& shape, int n, int particles_per_cell, double offset) {
  const double L = n, k = std::numbers::pi / L, frequency = std::numbers::sqrt2 * k * wave.speed, size = 1e-6;
  MpmScene scene;
  scene.shape = shape;
  scene.pace = fixed_step(0.1 * 8.0 / n);
  scene.tables =
      body("block", box({-2.0 * L + offset, -2.0 * L + offset}, {2.0 * L + offset, 2.0 * L + offset}),
           fmt::format("particles_per_cell = {}", particles_per_cell));
  MpmRun run(scene);
  Particles& p = run.particles();
  const VectorColumns start = p.position;
  const auto mode = [&](std::size_t i, std::size_t c) {
    const double x = k * start[0][i], y = k * start[1][i];
    return c == 0 ? std::sin(x) * std::cos(y) : wave.sign * std::cos(x) * std::sin(y);
  };
  for (std::size_t i = 0; i < p.size; ++i)
    for (std::size_t c = 0; c < 2; ++c) p.velocity[c][i] = size * mode(i, c);
  const double time = 0.35 * 2.0 * std::numbers::pi / frequency;
  run.advance(time);
  double sum = 0.0, scale = 0.0;
  for (std::size_t i = 0; i < p.size; ++i) {
    if (std::abs(start[0][i]) > 0.5 * L || std::abs(start[1][i]) > 0.5 * L) continue;
    for (std::size_t c = 0; c < 2; ++c) {
      const double v = size * mode(i, c) * std::cos(frequency * time);
      const double u = size * mode(i, c) * std::sin(frequency * time) / frequency;
      const double dv = p.velocity[c][i] - v, du = frequency * (p.position[c][i] - start[c][i] - u);
      sum += dv * dv + du * du;
      scale += size * size * mode(i, c) * mode(i, c);
    }
  }
  return std::sqrt(sum / scale);
}

}  // namespace

TEST_CASE("Spatial order: every shape function is of second order on a smooth elastic wave",
          "[verification][mpm]") {
  for (const Wave& wave : {pressure, shear})
    for (const char* shape : {"linear", "gimp", "bspline2"})
      for (const int ppc : {1, 4}) {
        const double e8 = error(wave, shape, 8, ppc, 0.0), e16 = error(wave, shape, 16, ppc, 0.0);
        const double measured = order(e8, e16);
        CAPTURE(wave.name, shape, ppc, e8, e16, measured);
        CHECK(e16 < 0.04);  // 16 cells to half a wavelength
        CHECK(measured > 1.8);
        CHECK(measured < 2.4);
      }
}

TEST_CASE("Spatial order: particles off the cells' centres", "[verification][mpm]") {
  for (const char* shape : {"linear", "gimp", "bspline2"}) {
    const double e8 = error(pressure, shape, 8, 1, 0.2), e16 = error(pressure, shape, 16, 1, 0.2);
    const double measured = order(e8, e16);
    CAPTURE(shape, e8, e16, measured);
    CHECK(measured > 1.8);
    CHECK(measured < 2.4);
  }
}
