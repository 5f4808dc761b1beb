#include <algorithm>
#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "mpm/stress.hpp"
#include "mpm/transfer.hpp"
#include "support/mpm_run.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

constexpr const char* schemes[] = {"usf", "usl", "musl"};

double angular_momentum(const Particles& p) {
  double sum = 0.0;
  for (std::size_t i = 0; i < p.size; ++i)
    sum += p.mass[i] * (p.position[0][i] * p.velocity[1][i] - p.position[1][i] * p.velocity[0][i]);
  return sum;
}

}  // namespace

TEST_CASE("A stress turns with the body: a full turn in 360 small ones brings it back",
          "[verification][mpm]") {
  // Only the strain and stress updates act: velocities stay those of a rigid rotation and particles where
  // they are.
  MpmScene scene;
  scene.tables = body("disk", box({-6.0, -6.0}, {6.0, 6.0}),
                      "velocity_gradient = [[0.0, -1.0], [1.0, 0.0]]\nstress = [-0.01, 0.02, 0.004, 0.003]");
  MpmRun run(scene);
  System& s = run.system;
  const SymmetricTensor start{-0.01, 0.02, 0.004, 0.003};
  const double turn = 2.0 * std::numbers::pi / 360.0;
  mpm::refresh_grid(s);
  mpm::scatter(s, mpm::Scatter::momentum);
  mpm::project_velocities(s);
  const auto deviation = [&](double angle) {
    const SymmetricTensor expected = rotate(start, {std::cos(angle), std::sin(angle)});
    const Particles& p = run.particles();
    const auto stress = mpm::stress_of(s.bodies[0]);
    double worst = 0.0;
    for (std::size_t i = 0; i < p.size; ++i)
      if (std::abs(p.position[0][i]) < 4.0 && std::abs(p.position[1][i]) < 4.0)
        worst = std::max({worst, std::abs(stress[0][i] - expected.rr), std::abs(stress[1][i] - expected.zz),
                          std::abs(stress[2][i] - expected.tt), std::abs(stress[3][i] - expected.rz)});
    return worst;
  };
  for (int n = 1; n <= 360; ++n) {
    mpm::gather(s, mpm::Gather::strain, turn);
    mpm::update_stress(s, turn);
    if (n == 45 || n == 360) CHECK(deviation(n * turn) < 1e-14);
  }
}

namespace {

/// How far a quarter turn of a free disk is from rigid: largest displacement error in cells, relative changes
/// of the rest.
struct TurnError {
  double place, momentum, kinetic;
};

TurnError quarter_turn(MpmScene scene, double radius) {
  const double rate = 0.02 / radius;  // the rim runs at 2 % of the wave speed
  scene.tables =
      body("disk", disk({0.0, 0.0}, radius),
           fmt::format("particles_per_cell = 4\nvelocity_gradient = [[0.0, {}], [{}, 0.0]]", -rate, rate));
  MpmRun run(scene);
  const Particles& p = run.particles();
  const VectorColumns start = p.position;
  const double initial = angular_momentum(p);
  run.advance(0.5 * std::numbers::pi / rate);
  TurnError e{0.0, angular_momentum(p) / initial - 1.0, run.energy().kinetic / run.energy().initial - 1.0};
  for (std::size_t i = 0; i < p.size; ++i)  // (x, y) -> (-y, x)
    e.place = std::max(e.place, std::hypot(p.position[0][i] + start[1][i], p.position[1][i] - start[0][i]));
  return e;
}

}  // namespace

// Particles move with the grid's velocity, which is a smoothed one: at a free rim they lag by a fraction of a
// cell. So errors of a turn are of first order in cell / radius.
TEST_CASE(
    "Rigid rotation: a quarter turn keeps energy, angular momentum and shape, the better the finer the grid",
    "[verification][mpm]") {
  for (const char* shape : {"linear", "gimp", "bspline2"})
    for (const char* scheme : {"usf", "musl"}) {  // USL: unstable, particles come near empty nodes
      MpmScene scene;
      scene.shape = shape, scene.scheme = scheme, scene.pace = "courant = 0.5";
      const TurnError coarse = quarter_turn(scene, 5.0), fine = quarter_turn(scene, 10.0);
      CAPTURE(shape, scheme, coarse.place, coarse.momentum, coarse.kinetic, fine.place, fine.momentum,
              fine.kinetic);
      CHECK(fine.place < 1.0);
      CHECK(std::abs(fine.momentum) < 0.05);
      CHECK(std::abs(fine.kinetic) < 0.05);
      CHECK(std::abs(fine.momentum) < 0.7 * std::abs(coarse.momentum));
    }
}

TEST_CASE("Between centroids a disk of ten cells keeps its angular momentum to 0.1 % in a quarter turn",
          "[verification][mpm]") {
  struct Method {
    const char *method, *scheme, *pace;
    double momentum, energy;  // tolerated
  };
  for (const char* shape : {"linear", "gimp", "bspline2"})
    for (const auto& [method, scheme, pace, momentum, energy] :
         {Method{"explicit", "usf", "courant = 0.4", 1e-3, 3e-3},
          {"explicit", "musl", "courant = 0.4", 1e-3, 3e-3},
          {"arkode-explicit", "usf", "rtol = 1e-4", 1e-4, 4e-4},
          {"arkode-implicit", "usf", "rtol = 1e-4\nremap = 2.0", 3e-3, 3e-3}}) {
      MpmScene scene;
      scene.shape = shape, scene.gradients = "centroids", scene.method = method, scene.scheme = scheme,
      scene.pace = pace;
      const TurnError turn = quarter_turn(scene, 5.0);
      CAPTURE(shape, method, scheme, turn.place, turn.momentum, turn.kinetic);
      CHECK(std::abs(turn.momentum) < momentum);
      CHECK(std::abs(turn.kinetic) < energy);
      CHECK(turn.place < 0.1);
    }
}

// 59 m/s at the rim stress glass with rho omega^2 R^2 (3 - 2 nu) / (8 (1 - nu)) = 3.6 MPa; between nodes it
// breaks within 1.3 us.
TEST_CASE("A glass disk that spins at a stress it bears by far does not break itself",
          "[verification][mpm]") {
  for (const char* shape : {"gimp", "bspline2"})
    for (const char* gradients : {"nodes", "centroids"}) {
      MpmRun run(parse_scene(
          fmt::format("[space]\ngeometry = \"plane-strain\"\ncell = 1e-3\nshape_functions = \"{}\"\n"
                      "gradients = \"{}\"\n[time]\nend = 1e-5\n[integrator]\nmethod = \"explicit\"\n"
                      "scheme = \"musl\"\ncourant = 0.4\n[[body]]\nname = \"disk\"\nmaterial = \"glass\"\n"
                      "disk = {{centre = [0.0, 0.0], radius = 0.005}}\nparticles_per_cell = 4\n"
                      "velocity_gradient = [[0.0, -1.1766e4], [1.1766e4, 0.0]]\n"
                      "[material.glass]\ndensity = 2500.0\nyoung = 72e9\npoisson = 0.25\n"
                      "[material.glass.damage]\ntoughness = 0.83e6\nk = 5.0e26\nm = 6\n"
                      "[material.glass.decohesion]\nopening = 5.0e-6\nq = 1.0\nmode_ratio = 50.0\n",
                      shape, gradients),
          "test.toml"));
      run.advance(1e-5);
      CAPTURE(shape, gradients);
      const bool broken = run.energy().fracture > 0.0;
      CHECK(broken == (std::string(gradients) == "nodes"));
    }
}

TEST_CASE("Free fall: the work of gravity is the kinetic energy, and the path the scheme's own parabola",
          "[verification][mpm]") {
  const double g = 9.81e-3, step = 0.2;
  for (const char* geometry : {"plane-strain", "axisymmetric"})
    for (const char* scheme : schemes) {
      CAPTURE(geometry, scheme);
      MpmScene scene;
      scene.geometry = geometry, scene.scheme = scheme, scene.pace = fixed_step(step);
      scene.tables = body("drop", box({0.0, 0.0}, {4.0, 5.0})) + "[gravity]\nacceleration = [0, -9.81e-3]\n";
      MpmRun run(scene);
      const std::vector<double> start = run.particles().position[1];
      const int steps = 400;
      run.advance(steps * step);
      const Particles& p = run.particles();
      // Velocity first, then position: x_n = -g dt^2 n (n + 1) / 2, first order away from -g t^2 / 2.
      const double fallen = -g * step * step * 0.5 * steps * (steps + 1),
                   parabola = -0.5 * g * std::pow(steps * step, 2);
      CHECK(fallen == Approx(parabola).epsilon(1.01 / steps));
      for (std::size_t i = 0; i < p.size; ++i) {
        REQUIRE(p.position[1][i] - start[i] == Approx(fallen).epsilon(1e-12));
        REQUIRE(p.velocity[1][i] == Approx(-g * step * steps).epsilon(1e-12));
        REQUIRE(std::abs(p.velocity[0][i]) < 1e-12);
      }
      CHECK(run.energy().external == Approx(run.energy().kinetic).epsilon(1e-12));
      CHECK(std::abs(run.energy().relative_residual()) < 1e-12);
    }
}

TEST_CASE("Momentum is conserved to rounding in a collision", "[verification][mpm]") {
  for (const char* geometry : {"plane-strain", "axisymmetric"})
    for (const char* shape : {"linear", "gimp", "bspline2"})
      for (const char* scheme : schemes) {
        CAPTURE(geometry, shape, scheme);
        const bool axisymmetric = std::string(geometry) == "axisymmetric";
        // USL is unstable at once where the wide shape functions of a round body graze a node.
        if (std::string(scheme) == "usl" && std::string(shape) != "linear") continue;
        MpmScene scene;
        scene.geometry = geometry, scene.shape = shape, scene.scheme = scheme, scene.pace = "step = 0.02";
        scene.tables = body("plate", box({0.0, 0.0}, {12.0, 3.0}), "particles_per_cell = 4") +
                       body("ball", disk({0.0, 6.0}, 2.9),
                            axisymmetric ? "velocity = [0.0, -0.05]" : "velocity = [0.01, -0.05]");
        MpmRun run(scene);
        const auto before = total_momentum(run.system);
        // USL is soon unstable where particles come near empty nodes; a short contact must do.
        run.advance(std::string(scheme) == "usl" ? 3.0 : 12.0);
        const auto after = total_momentum(run.system);
        CHECK(run.energy().elastic > 1e-5 * run.energy().initial);
        CHECK(std::abs(after[1] / before[1] - 1.0) < 1e-12);
        if (!axisymmetric) CHECK(std::abs(after[0] / before[0] - 1.0) < 1e-12);
      }
}
