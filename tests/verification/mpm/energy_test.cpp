#include <algorithm>
#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "support/mpm_measure.hpp"
#include "support/mpm_run.hpp"

using namespace vitrum;
using namespace vitrum::test;

// With exact integration in time the particle system conserves energy for any positions: d/dt of the
// particles' kinetic energy is sum v_i . f_i = minus the stress power. So what the ledger misses is the
// schemes' own error, and vanishes with the step.

namespace {

constexpr const char* schemes[] = {"usf", "usl", "musl"};

/// A free block with a smooth velocity field, far below the strains at which nonlinear terms would show.
/// drift: its speed.
MpmRun swinging_block(const std::string& shape, const std::string& scheme, double step, double drift) {
  MpmScene scene;
  scene.shape = shape, scene.scheme = scheme, scene.pace = fixed_step(step);
  // Half a cell off the grid: no node is nearly empty, so that USL is stable too.
  scene.tables = body("block", box({0.5, 0.5}, {10.5, 8.5}), "particles_per_cell = 4");
  MpmRun run(scene);
  Particles& p = run.particles();
  for (std::size_t i = 0; i < p.size; ++i) {
    const double x = std::numbers::pi * (p.position[0][i] - 0.5) / 10.0,
                 y = std::numbers::pi * (p.position[1][i] - 0.5) / 8.0;
    p.velocity[0][i] = 1e-4 * (std::cos(x) + 0.5 * std::sin(y)) + drift;
    p.velocity[1][i] = 1e-4 * (0.7 * std::cos(2.0 * y) * std::sin(x));
  }
  run.reopen_ledger();
  return run;
}

/// Largest |residual| during `time`, relative to the energy of the vibration.
double largest_residual(MpmRun run, double time, double drift) {
  const Particles& p = run.particles();
  double vibration = 0.0, worst = 0.0;
  for (std::size_t i = 0; i < p.size; ++i)
    vibration += 0.5 * p.mass[i] * (std::pow(p.velocity[0][i] - drift, 2) + std::pow(p.velocity[1][i], 2));
  MpmRun* const r = &run;
  run.watch = [&](double) {
    worst = std::max(worst, std::abs(r->energy().residual()) / vibration);
    return true;
  };
  run.advance(time);
  return worst;
}

}  // namespace

TEST_CASE("The energy residual of an elastic body falls with the step, first order", "[verification][mpm]") {
  for (const char* shape : {"linear", "gimp", "bspline2"})
    for (const char* scheme : schemes) {
      // USL damps short waves strongly: its first order shows only with small steps.
      const double usl = std::string(scheme) == "usl" ? 0.25 : 1.0;
      const double coarse = largest_residual(swinging_block(shape, scheme, 0.04 * usl, 0.0), 20.0, 0.0);
      const double fine = largest_residual(swinging_block(shape, scheme, 0.01 * usl, 0.0), 20.0, 0.0);
      const double measured = order(coarse, fine, 4.0);
      CAPTURE(shape, scheme, coarse, fine, measured);
      CHECK(coarse < 0.1);
      CHECK(measured > 0.85);
      CHECK(measured < 1.3);
    }
}

TEST_CASE("The energy residual falls with the step also when particles travel through cells",
          "[verification][mpm]") {
  const double drift = 0.3;  // of the wave speed: six cells in the run
  for (const char* shape : {"gimp", "bspline2"})
    for (const char* scheme : {"usf", "musl"}) {
      const double coarse = largest_residual(swinging_block(shape, scheme, 0.02, drift), 20.0, drift);
      const double fine = largest_residual(swinging_block(shape, scheme, 0.005, drift), 20.0, drift);
      const double measured = order(coarse, fine, 4.0);
      CAPTURE(shape, scheme, coarse, fine, measured);
      CHECK(measured > 0.8);
    }
}

TEST_CASE("Every step's change of kinetic energy is what the grid's momenta say, to rounding",
          "[verification][mpm]") {
  // dK = sum p_i (w_i - v_i) + sum m_p |dv_p|^2 / 2 with the momenta before the forces, for any shape
  // functions and positions.
  for (const char* geometry : {"plane-strain", "axisymmetric"})
    for (const char* shape : {"linear", "gimp", "bspline2"}) {
      CAPTURE(geometry, shape);
      MpmScene scene;
      scene.geometry = geometry, scene.shape = shape, scene.pace = "step = 0.2";
      scene.tables = body("plate", box({0.0, 0.0}, {12.0, 3.0}), "particles_per_cell = 4") +
                     body("ball", disk({0.0, 6.0}, 2.9), "velocity = [0.0, -0.1]");
      MpmRun run(scene);
      // By identity: particles change places in memory while they run.
      const auto velocities = [&] {
        std::vector<double> v;
        for (const Body& b : run.system.bodies) {
          const std::size_t first = v.size();
          v.resize(first + 2 * b.particles.size);
          for (std::size_t i = 0; i < b.particles.size; ++i)
            for (std::size_t c = 0; c < 2; ++c)
              v[first + 2 * b.particles.identity[i] + c] = b.particles.velocity[c][i];
        }
        return v;
      };
      std::vector<double> before = velocities();
      double kinetic = run.system.record.kinetic, worst = 0.0;
      run.watch = [&](double) {
        const mpm::Grid& grid = run.system.grid;
        using mpm::Field;
        double expected = 0.0;
        for (std::size_t n = 0; n < grid.blocks().size() * mpm::block_nodes; ++n)
          for (const auto& [v, w] : {std::pair(Field::velocity_0, Field::new_velocity_0),
                                     std::pair(Field::velocity_1, Field::new_velocity_1)})
            expected += grid.field(Field::mass)[n] * grid.field(v)[n] * (grid.field(w)[n] - grid.field(v)[n]);
        const std::vector<double> after = velocities();
        std::size_t first = 0;
        for (const Body& b : run.system.bodies) {
          for (std::size_t i = 0; i < b.particles.size; ++i)
            for (std::size_t k = first + 2 * b.particles.identity[i], end = k + 2; k < end; ++k)
              expected += 0.5 * b.particles.mass[i] * (after[k] - before[k]) * (after[k] - before[k]);
          first += 2 * b.particles.size;
        }
        worst = std::max(worst, std::abs(run.system.record.kinetic - kinetic - expected));
        kinetic = run.system.record.kinetic, before = after;
        return true;
      };
      run.advance(20.0);
      CAPTURE(worst / run.energy().initial);
      CHECK(run.energy().elastic > 1e-3 * run.energy().initial);
      CHECK(worst < 1e-13 * run.energy().initial);
    }
}

TEST_CASE("USF, USL and MUSL become one as the step vanishes, first order", "[verification][mpm]") {
  const auto velocities = [](const char* scheme, double step) {
    MpmRun run = swinging_block("bspline2", scheme, step, 0.0);
    run.advance(10.0);
    return run.particles().velocity;
  };
  const auto difference = [](const auto& a, const auto& b) {
    double sum = 0.0;
    for (std::size_t c = 0; c < 2; ++c)
      for (std::size_t i = 0; i < a[c].size(); ++i) sum += (a[c][i] - b[c][i]) * (a[c][i] - b[c][i]);
    return std::sqrt(sum / static_cast<double>(a[0].size())) / 1e-4;
  };
  const char* pairs[][2] = {{"usf", "usl"}, {"usf", "musl"}, {"usl", "musl"}};
  for (const auto& [one, other] : pairs) {
    const double coarse = difference(velocities(one, 0.04), velocities(other, 0.04));
    const double fine = difference(velocities(one, 0.01), velocities(other, 0.01));
    const double measured = order(coarse, fine, 4.0);
    CAPTURE(one, other, coarse, fine, measured);
    CHECK(fine < 0.02);
    CHECK(measured > 0.85);
    CHECK(measured < 1.3);
  }
}

TEST_CASE("A piston's work on an elastic block is found in the block, the better the smaller the step",
          "[verification][mpm]") {
  for (const char* scheme : schemes) {
    const auto residual = [&](double step) {
      MpmScene scene;
      scene.scheme = scheme, scene.pace = fixed_step(step);
      scene.tables = body("block", box({0.0, 0.0}, {12.0, 6.0}), "particles_per_cell = 4") +
                     hold("[-inf, -inf]", "[0, inf]", "\"x\"") + hold("[-inf, -inf]", "[inf, 0]", "\"y\"") +
                     hold("[-inf, 6]", "[inf, inf]", "\"y\"") +
                     hold("[12, -inf]", "[inf, inf]", "\"x\"", {-1e-5, 0.0});
      MpmRun run(scene);
      run.advance(40.0);
      const EnergyTotals& e = run.energy();
      CHECK(e.initial == 0.0);
      CHECK(e.external > 0.0);
      // Held on all sides: after 40 time units the strain is 40e-5/12 on average and energy mostly elastic.
      CHECK(e.elastic > 0.5 * 72.0 * std::pow(40e-5 / 12.0, 2) * 0.9);
      return std::abs(e.relative_residual());
    };
    const double coarse = residual(0.2), fine = residual(0.05);
    CAPTURE(scheme, coarse, fine);
    CHECK(coarse < 0.02);
    // USL destroys the short waves of the sudden start more slowly than in proportion to the step.
    CHECK(fine < (std::string(scheme) == "usl" ? 0.8 : 0.5) * coarse);
  }
}
