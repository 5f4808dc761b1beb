#include "app/local_cost.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <optional>

#include "integrators/local/local_method.hpp"

namespace vitrum::app {
namespace {

using Clock = std::chrono::steady_clock;

/// Strain rates in proportion: tension, shear, and crushing with shear.
constexpr std::array<SymmetricTensor, 3> directions{SymmetricTensor{1.0, 0.1, 0.1, 0.0},
                                                    SymmetricTensor{0.7, -0.7, 0.0, 0.7},
                                                    SymmetricTensor{-1.0, 0.7, 0.0, 0.5}};

/// The strain, to a factor of two, at which the closed form begins to dissipate; none where it does not.
std::optional<double> onset(const Material& material, const SymmetricTensor& direction, double step) {
  for (double strain = 1e-6; strain < 0.1; strain *= 2.0) {
    PointState s = material.start({});
    PointReport report;
    material.advance(s, strain * direction, step, report);
    if (s.dissipated > 0.0) return strain;
  }
  return std::nullopt;
}

/// s for one increment beyond the onset, the least of some repetitions; 0 where the method fails.
double increment_seconds(const Material& material, PointIntegrator& local, const SymmetricTensor& direction,
                         double limit, double step) {
  constexpr int repetitions = 3, increments = 40;
  double least = 0.0;
  for (int n = 0; n < repetitions; ++n) {
    PointState s = material.start({});
    PointReport report;
    material.advance(s, 0.5 * limit * direction, step, report);
    int active = 0;
    Clock::duration taken{};
    for (int k = 0; k < increments && !report.failed(); ++k) {
      const double before = s.dissipated;
      report.clear();
      const Clock::time_point begun = Clock::now();
      local.integrate(material, s, 0.05 * limit * direction, step, report);
      const Clock::duration of_increment = Clock::now() - begun;
      if (s.dissipated > before) taken += of_increment, ++active;
    }
    if (active == 0) return 0.0;
    const double seconds = std::chrono::duration<double>(taken).count() / active;
    least = n == 0 ? seconds : std::min(least, seconds);
  }
  return least;
}

}  // namespace

double costliest_evaluation(const Scene& scene, const System& system, double step) {
  if (scene.constitutive.method == LocalMethod::closed_form) return 0.0;
  const std::unique_ptr<LocalIntegrator> local = make_local_integrator(scene.constitutive);
  double sum = 0.0;
  for (const Body& body : system.bodies) {
    double costliest = 0.0;
    for (const SymmetricTensor& direction : directions)
      if (const std::optional<double> limit = onset(*body.material, direction, step))
        costliest = std::max(costliest, increment_seconds(*body.material, *local, direction, *limit, step));
    sum += costliest * static_cast<double>(body.particles.size);
  }
  return sum;
}

}  // namespace vitrum::app
