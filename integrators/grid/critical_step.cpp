#include "integrators/grid/critical_step.hpp"

#include <cmath>
#include <limits>
#include <numbers>

namespace vitrum {

double stability_limit(StepScheme scheme) {
  // USF and MUSL are leapfrog on the particle system, whose largest frequency is at most 2 sqrt(2) c/h for
  // any particle positions.
  return scheme == StepScheme::usl ? 0.5 : 1.0 / std::numbers::sqrt2;
}

double largest_speed(const Particles& p) {
  double largest = 0.0;
  for (std::size_t i = 0; i < p.size; ++i)
    largest = std::max(largest, p.velocity[0][i] * p.velocity[0][i] + p.velocity[1][i] * p.velocity[1][i]);
  return std::sqrt(largest);
}

CriticalStep critical_step(const System& system, double limit) {
  CriticalStep result{std::numeric_limits<double>::infinity(), 0.0, 0.0, ""};
  for (const Body& body : system.bodies) {
    const double c = body.material->wave_speed(), v = largest_speed(body.particles);
    const double step = limit * system.cell / (c + v);
    if (step < result.step) result = {step, c, v, body.name};
  }
  return result;
}

}  // namespace vitrum
