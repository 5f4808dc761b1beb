#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "support/mpm_run.hpp"
#include "vitrum_source_dir.hpp"

namespace vitrum::test {

/// The paper's reference scene with changes (--set texts).
inline Scene reference(const std::vector<std::string>& changes) {
  return read_scene(VITRUM_SOURCE_DIR "/studies/paper/reference.toml", changes);
}

/// Changes for a plate of another radius (m).
inline std::vector<std::string> plate_radius(double radius) {
  return {fmt::format("body.0.box.max.0={}", radius), fmt::format("boundary.0.box.min.0={}", radius),
          fmt::format("boundary.0.box.max.0={}", radius + 0.1)};
}

/// Changes for another impact velocity (m/s) over a gap (m): first touch is at t = 0.
inline std::vector<std::string> impact(double speed, double gap) {
  return {fmt::format("body.1.velocity.1={}", -speed), fmt::format("time.start={}", -gap / speed),
          fmt::format("body.1.box.min.1={}", 5e-3 + gap), fmt::format("body.1.box.max.1={}", 55e-3 + gap)};
}

inline std::vector<std::string> operator+(std::vector<std::string> a, const std::vector<std::string>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Largest energy growth and largest particle speed of a run.
struct Extent {
  double growth = 0.0, speed = 0.0;
};

inline double largest_speed(const System& system) {
  double largest = 0.0;
  for (const Body& b : system.bodies)
    for (std::size_t i = 0; i < b.particles.size; ++i)
      largest = std::max(largest, std::hypot(b.particles.velocity[0][i], b.particles.velocity[1][i]));
  return largest;
}

/// Runs to `end` (s), looking at every step.
inline Extent run_to(MpmRun& run, double end) {
  Extent extent;
  run.watch = [&](double) {
    extent.growth = std::max(extent.growth, run.ledger.growth(run.integrator.tolerated_energy(run.system)));
    extent.speed = std::max(extent.speed, largest_speed(run.system));
    return std::isfinite(extent.growth);
  };
  run.advance(end);
  return extent;
}

}  // namespace vitrum::test
