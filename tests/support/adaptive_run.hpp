#pragma once
#include <cmath>
#include <numbers>

#include "support/mpm_run.hpp"

namespace vitrum::test {

/// Velocity amplitude of `swinging_body`; in units of the wave speed.
inline constexpr double swing = 1e-4;

/// A free elastic block with a smooth velocity field whose particles stay within the pieces of their shape
/// functions. integrator: lines of [integrator] after `method`.
inline MpmRun swinging_body(const std::string& method, const std::string& integrator,
                            const std::string& shape = "bspline2",
                            const std::string& geometry = "plane-strain") {
  MpmScene scene;
  scene.geometry = geometry, scene.shape = shape, scene.method = method;
  scene.pace = integrator;
  if (method != "explicit")
    scene.pace += fmt::format("\nvelocity_scale = {}\nstrain_scale = {}", swing, swing);
  scene.tables = body("block", box({0.0, 0.0}, {8.0, 6.0}), "particles_per_cell = 4");
  MpmRun run(scene);
  Particles& p = run.particles();
  for (std::size_t i = 0; i < p.size; ++i) {
    const double x = std::numbers::pi * p.position[0][i] / 8.0, y = std::numbers::pi * p.position[1][i] / 6.0;
    p.velocity[0][i] = swing * std::sin(x) * (1.0 + 0.5 * std::cos(y));
    p.velocity[1][i] = 0.7 * swing * std::cos(y) * std::cos(x);
  }
  run.reopen_ledger();
  return run;
}

/// Largest difference of the velocities of two runs, relative to the swing.
inline double velocity_difference(const MpmRun& a, const MpmRun& b) {
  double largest = 0.0;
  for (std::size_t n = 0; n < a.system.bodies.size(); ++n)
    for (std::size_t c = 0; c < 2; ++c) {
      const auto &v = a.system.bodies[n].particles.velocity[c], &w = b.system.bodies[n].particles.velocity[c];
      for (std::size_t i = 0; i < v.size(); ++i) largest = std::max(largest, std::abs(v[i] - w[i]));
    }
  return largest / swing;
}

}  // namespace vitrum::test
