#include <cmath>

#include "catch.hpp"
#include "support/mpm_run.hpp"

using namespace vitrum;
using namespace vitrum::test;

// An elastic ball lands on an elastic block, with every parameter at the ends of what a scene may ask for.
// Unless said otherwise density, wave speed and cell are 1.

namespace {

struct Collision {
  double cell = 1.0, young = unit_young, density = 1.0, poisson = unit_poisson;
  double ball_young = 1.0, ball_density = 1.0;  ///< times the block's
  double speed = 0.05;                          ///< over the block's wave speed
  int particles_per_cell = 4;
  std::string scheme = "musl", shape = "linear";

  double wave_speed() const {
    return std::sqrt(young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson)) / density);
  }
  MpmScene scene() const {
    MpmScene s;
    s.geometry = "axisymmetric", s.cell = cell, s.shape = shape, s.scheme = scheme;
    s.density = density, s.young = young, s.poisson = poisson;
    const std::string fine = fmt::format("particles_per_cell = {}\n", particles_per_cell);
    std::string ball = body("ball", disk({0.0, 5.5 * cell}, 2.0 * cell),
                            fine + "velocity = " + pair({0.0, -speed * wave_speed()}));
    const std::string own = "material = \"elastic\"";
    ball.replace(ball.find(own), own.size(), "material = \"other\"");
    s.tables = body("block", box({0.0, 0.0}, {6.0 * cell, 3.0 * cell}), fine) + ball +
               fmt::format("[material.other]\ndensity = {:.17g}\nyoung = {:.17g}\npoisson = {:.17g}\n",
                           density * ball_density, young * ball_young, poisson);
    return s;
  }
};

/// Runs for `transits` times that a wave takes through a cell of the block; energy never grows by more than
/// 2 %.
MpmRun require_sound(const Collision& c, double transits = 60.0) {
  MpmRun run(c.scene());
  const double end = transits * c.cell / c.wave_speed();
  double growth = 0.0;
  run.watch = [&](double) {
    growth = std::max(growth, run.ledger.growth());
    return std::isfinite(growth);
  };
  run.advance(end);
  CAPTURE(growth, run.energy().relative_residual(), c.scheme, c.shape, c.speed, c.young, c.poisson, c.cell,
          c.ball_young, c.ball_density, c.particles_per_cell);
  REQUIRE(run.system.time == end);
  REQUIRE(growth <= 1.02);
  REQUIRE(std::abs(run.energy().relative_residual()) < 0.1);
  return run;
}

/// Positions in cells and velocities in wave speeds of all particles.
std::vector<double> dimensionless(const MpmRun& run, const Collision& c) {
  std::vector<double> values;
  for (const Body& b : run.system.bodies)
    for (std::size_t k = 0; k < 2; ++k)
      for (std::size_t i = 0; i < b.particles.size; ++i) {
        values.push_back(b.particles.position[k][i] / c.cell);
        values.push_back(b.particles.velocity[k][i] / c.wave_speed());
      }
  return values;
}

double distance(const std::vector<double>& a, const std::vector<double>& b) {
  REQUIRE(a.size() == b.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
  return largest;
}

}  // namespace

TEST_CASE("Cells from a micrometre to ten metres, moduli from 1 Pa to 1e15: the same dimensionless result",
          "[stability][extreme]") {
  const Collision unit;
  const std::vector<double> expected = dimensionless(require_sound(unit, 40.0), unit);
  for (const double cell : {1e-6, 1e-3, 10.0}) {
    Collision scaled;
    scaled.cell = cell;
    CAPTURE(cell);
    CHECK(distance(dimensionless(require_sound(scaled, 40.0), scaled), expected) < 1e-9);
  }
  for (const double young : {1.0, 1e6, 1e15}) {
    Collision scaled;
    scaled.young = young, scaled.density = 2500.0;
    CAPTURE(young);
    CHECK(distance(dimensionless(require_sound(scaled, 40.0), scaled), expected) < 1e-9);
  }
}

TEST_CASE("Powers of two scale without any rounding", "[stability][extreme]") {
  const Collision unit;
  const std::vector<double> expected = dimensionless(require_sound(unit, 40.0), unit);
  for (const double cell : {0x1p-20, 0x1p-10, 0x1p4}) {
    Collision scaled;
    scaled.cell = cell;
    CAPTURE(cell);
    CHECK(distance(dimensionless(require_sound(scaled, 40.0), scaled), expected) == 0.0);
  }
}

TEST_CASE("Poisson's ratio from -0.9 to 0.4999", "[stability][extreme]") {
  for (const double poisson : {-0.9, -0.5, 0.0, 0.4, 0.49, 0.499, 0.4999}) {
    Collision c;
    c.poisson = poisson;
    require_sound(c);
  }
}

TEST_CASE("Ratios of density and of stiffness of a million", "[stability][extreme]") {
  for (const double ratio : {1e-6, 1e-3, 1e3, 1e6}) {
    Collision density, young;
    density.ball_density = ratio, young.ball_young = ratio;
    require_sound(density, ratio < 1e-3 ? 30.0 : 100.0);
    require_sound(young, ratio > 1e3 ? 30.0 : 100.0);
  }
}

TEST_CASE("Speeds from 1e-7 to twice the wave speed", "[stability][extreme]") {
  for (const char* shape : {"linear", "bspline2"})
    for (const double speed : {1e-7, 1e-3, 0.5, 1.0, 2.0}) {
      Collision c;
      c.speed = speed, c.shape = shape;
      require_sound(c);
    }
}

TEST_CASE("1, 4, 9 and 16 particles a cell", "[stability][extreme]") {
  for (const char* shape : {"linear", "gimp", "bspline2"})
    for (const int n : {1, 4, 9, 16}) {
      Collision c;
      c.particles_per_cell = n, c.shape = shape;
      require_sound(c);
    }
}

TEST_CASE("A million particles", "[stability][extreme]") {
  MpmScene scene;
  scene.scheme = "musl", scene.geometry = "axisymmetric";
  scene.tables = body("block", box({0.0, 0.0}, {500.0, 500.0}), "particles_per_cell = 4") +
                 body("ball", disk({0.0, 503.5}, 3.5), "velocity = [0.0, -0.05]");
  MpmRun run(scene, 2);
  REQUIRE(run.system.particle_count() > 1000000);
  double growth = 0.0;
  run.watch = [&](double) {
    growth = std::max(growth, run.ledger.growth());
    return true;
  };
  run.advance(4.0);
  CAPTURE(growth, run.energy().relative_residual());
  CHECK(growth <= 1.02);
  CHECK(std::abs(run.energy().relative_residual()) < 0.02);
}

TEST_CASE("Bodies fly over a million cells and arrive to the digit, as they started",
          "[stability][extreme]") {
  for (const char* scheme : {"usf", "usl", "musl"})
    for (const double side : {1.0, 8.0})
      for (const double speed : {0.1, 1000.0}) {
        CAPTURE(scheme, side, speed);
        MpmScene scene;
        scene.scheme = scheme, scene.pace = "courant = 0.5";
        scene.tables = body("grain", box({0.0, 0.0}, {side, side}), "velocity = " + pair({0.0, -speed}));
        MpmRun run(scene);
        run.advance((speed > 1.0 ? 1e6 : 1e4) / speed);
        const Particles& p = run.particles();
        CHECK(p.position[1][0] == Approx(0.5 - (speed > 1.0 ? 1e6 : 1e4)).epsilon(1e-9));
        CHECK(run.energy().max_growth == 1.0);
        for (std::size_t i = 0; i < p.size; ++i) REQUIRE(p.velocity[1][i] == -speed);
      }
}
