#include "scene/thread_count.hpp"

#include <algorithm>
#include <thread>

namespace vitrum {
namespace {

/// A particle's share of a step, relative to linear shape functions (docs/reports/performance-measurements.md).
double cost_of(mpm::ShapeKind shape) {
  switch (shape) {
    case mpm::ShapeKind::linear:
      return 1.0;
    case mpm::ShapeKind::gimp:
      return 2.6;
    case mpm::ShapeKind::cpgimp:
      return 3.5;
    case mpm::ShapeKind::bspline2:
      return 1.7;
  }
  return 1.0;
}

/// The same of a material, relative to an elastic one: models take time in proportion to what they store.
double cost_of(const Material& material) {
  constexpr double of_variable = 0.15;
  return 1.0 + of_variable * static_cast<double>(material.columns().size());
}

/// What a step computes between two times that threads meet, in elastic particles with linear shape
/// functions. ARKODE's vectors make them meet four times as often for the same work.
double work_between_meetings(const Scene& scene, const System& system) {
  double work = 0.0;
  for (const Body& body : system.bodies)
    work += static_cast<double>(body.particles.size) * cost_of(*body.material);
  return work * cost_of(scene.shape_functions) *
         (scene.integrator.method == GridMethod::arkode_explicit ? 0.25 : 1.0);
}

}  // namespace

int available_threads() {
  return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
}

int thread_count(const Scene& scene, const System& system, int available) {
  // Two threads gave 1.2 (cores far from each other) at 2,000 elastic particles, nothing at 1,280; with
  // arkode-explicit between 0.8 and 1.2 at 5,120.
  constexpr double worth_a_thread = 2500.0, most = 1024.0;
  const double useful = std::min(1.0 + work_between_meetings(scene, system) / worth_a_thread, most);
  return std::max(1, std::min(static_cast<int>(useful), available));
}

}  // namespace vitrum
