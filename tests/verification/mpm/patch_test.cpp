#include <algorithm>
#include <array>
#include <cmath>

#include "catch.hpp"
#include "support/mpm_run.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

constexpr const char* shapes[] = {"linear", "gimp", "bspline2"};
constexpr const char* schemes[] = {"usf", "usl", "musl"};

using Gradient = std::array<std::array<double, 2>, 2>;

/// Velocity gradient of the patch, 1/s: stretch, shear and spin at once.
constexpr Gradient all_at_once{{{1.0e-3, 2.0e-3}, {-0.5e-3, -1.5e-3}}};

MpmScene uniform_strain_patch(const char* shape, const char* scheme, int particles_per_cell, double step,
                              const Gradient& gradient = all_at_once) {
  MpmScene scene;
  scene.shape = shape, scene.scheme = scheme, scene.pace = fixed_step(step);
  const std::string rows =
      fmt::format("velocity_gradient = [{}, {}]\nvelocity = [3.0, -2.0]",
                  pair({gradient[0][0], gradient[0][1]}), pair({gradient[1][0], gradient[1][1]}));
  scene.tables = body("patch", box({-8.0, -8.0}, {8.0, 8.0}),
                      fmt::format("particles_per_cell = {}\n{}", particles_per_cell, rows));
  return scene;
}

/// Elastic strain after `time` of uniform strain rate: the corotational integral, to second order in the
/// small spin.
SymmetricTensor expected_strain(double time) {
  const Gradient& L = all_at_once;
  const double spin = 0.5 * time * (L[1][0] - L[0][1]);
  const SymmetricTensor straight{time * L[0][0], time * L[1][1], 0.0, 0.5 * time * (L[0][1] + L[1][0])};
  return rotate(straight, rotation_by(0.5 * spin));
}

/// Largest deviation of any component from `expected` among particles within `reach` of the origin; counts
/// them.
double largest_deviation(const Particles& p, const SymmetricTensor& expected, double reach, int& looked_at) {
  const double components[4] = {expected.rr, expected.zz, expected.tt, expected.rz};
  double worst = 0.0;
  for (std::size_t i = 0; i < p.size; ++i) {
    if (std::abs(p.position[0][i]) > reach || std::abs(p.position[1][i]) > reach) continue;
    ++looked_at;
    for (std::size_t k = 0; k < 4; ++k)
      worst = std::max(worst, std::abs(p.elastic_strain[k][i] - components[k]));
  }
  return worst;
}

/// Body that fills a block whose rim of nodes is held; nothing should ever move.
double largest_speed_of_resting_block(const MpmScene& scene, int steps, double step) {
  MpmRun run(scene);
  run.advance(steps * step);
  const Particles& p = run.particles();
  double largest = 0.0;
  for (std::size_t i = 0; i < p.size; ++i)
    largest = std::max(largest, std::hypot(p.velocity[0][i], p.velocity[1][i]));
  return largest;
}

}  // namespace

TEST_CASE("Patch test: a uniform strain rate gives every interior particle the same strain, exactly",
          "[verification][mpm]") {
  const double step = 0.1;
  for (const char* shape : shapes)
    for (const char* scheme : schemes)
      for (const int ppc : {1, 4, 9}) {
        CAPTURE(shape, scheme, ppc);
        MpmRun run(uniform_strain_patch(shape, scheme, ppc, step));
        run.advance(step);
        int looked_at = 0;
        const double worst = largest_deviation(run.particles(), expected_strain(step), 4.0, looked_at);
        CAPTURE(worst);
        CHECK(looked_at == 64 * ppc);
        CHECK(worst < 1e-15);  // velocities are of order 1, their rounding 1e-16
      }
}

TEST_CASE("Patch test: a step that turns by w strains by w^2/6 more than the corotational integral",
          "[verification][mpm]") {
  constexpr int points = 1000;
  const SymmetricTensor stretching{0.01, -0.01, 0.0, 0.0};
  for (const double w : {0.6, 0.3, 0.15}) {
    const Gradient turning{{{0.01, -w}, {w, -0.01}}};
    MpmScene scene = uniform_strain_patch("linear", "usf", 4, 1.0, turning);
    scene.tables.replace(scene.tables.find("[3.0, -2.0]"), 11, "[0.0, 0.0]");
    MpmRun run(scene);
    run.advance(1.0);
    SymmetricTensor exact{};  // integral of R^T D R, turned by the whole angle
    for (int k = 0; k < points; ++k)
      exact += (1.0 / points) * rotate(stretching, rotation_by(w - w * (k + 0.5) / points));
    int looked_at = 0;
    const double beyond = largest_deviation(run.particles(), (1.0 + w * w / 6.0) * exact, 4.0, looked_at);
    CAPTURE(w);
    CHECK(looked_at > 150);
    CHECK(beyond < 0.03 * w * w * w * w * norm(exact));
  }
}

TEST_CASE("Patch test: over many steps the interior stays uniform until the free edges are heard",
          "[verification][mpm]") {
  const double step = 0.05;
  for (const char* shape : shapes)
    for (const char* scheme : schemes) {
      CAPTURE(shape, scheme);
      MpmScene scene = uniform_strain_patch(shape, scheme, 4, step);
      // No translation here: 40 steps of it would carry the patch through the grid and mix in cell crossing.
      scene.tables.replace(scene.tables.find("[3.0, -2.0]"), 11, "[0.0, 0.0]");
      MpmRun run(scene);
      run.advance(40 * step);
      int looked_at = 0;
      const SymmetricTensor expected = expected_strain(40 * step);
      const double worst = largest_deviation(run.particles(), expected, 2.0, looked_at) / norm(expected);
      CAPTURE(worst);
      CHECK(looked_at == 64);
      CHECK(worst <
            5e-3);  // the particles' lattice is no longer the grid's: of the order of the strain, 4e-3
    }
}

TEST_CASE("Equilibrium: a uniformly stressed block anywhere on the grid stays at rest, plane strain",
          "[verification][mpm]") {
  const double step = 0.3;
  for (const char* shape : shapes)
    for (const int ppc : {1, 4, 9})
      for (const double offset : {0.0, 0.3, 0.499}) {
        CAPTURE(shape, ppc, offset);
        MpmScene scene;
        scene.shape = shape, scene.pace = fixed_step(step);
        scene.tables =
            body("block", box({offset, 0.7 * offset}, {16.0 + offset, 16.0 + 0.7 * offset}),
                 fmt::format("particles_per_cell = {}\nstress = [-0.01, -0.02, -0.005, 0.003]", ppc)) +
            hold("[-inf, -inf]", "[3, inf]", R"("x", "y")") +
            hold("[13, -inf]", "[inf, inf]", R"("x", "y")") +
            hold("[-inf, -inf]", "[inf, 3]", R"("x", "y")") + hold("[-inf, 13]", "[inf, inf]", R"("x", "y")");
        const double speed = largest_speed_of_resting_block(scene, 100, step);
        CAPTURE(speed);
        CHECK(speed < 1e-15);
      }
}

TEST_CASE("Equilibrium: hydrostatic stress does not move an axisymmetric block, near the axis neither",
          "[verification][mpm]") {
  const double step = 0.3, pressure = 0.01;
  for (const char* shape : shapes)
    for (const int ppc : {1, 4, 9}) {
      CAPTURE(shape, ppc);
      MpmScene scene;
      scene.geometry = "axisymmetric", scene.shape = shape, scene.pace = fixed_step(step);
      scene.tables = body("block", box({0.0, 0.3}, {16.0, 16.3}),
                          fmt::format("particles_per_cell = {}\nstress = [{}, {}, {}, 0.0]", ppc, -pressure,
                                      -pressure, -pressure)) +
                     hold("[13, -inf]", "[inf, inf]", R"("r", "z")") +
                     hold("[-inf, -inf]", "[inf, 3]", R"("r", "z")") +
                     hold("[-inf, 13]", "[inf, inf]", R"("r", "z")");
      const double speed = largest_speed_of_resting_block(scene, 100, step);
      CAPTURE(speed);
      // Quadratic splines meet the axis with a kink in (r N)': the two-point rule of 2 x 2 particles misses
      // it by 1/64 of p h.
      const bool inexact = std::string(shape) == "bspline2" && ppc == 4;
      CHECK(speed < (inexact ? 0.03 * pressure : 1e-14));
    }
}
