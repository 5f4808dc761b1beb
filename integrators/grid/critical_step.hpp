#pragma once
#include <string>

#include "integrators/grid/step_scheme.hpp"
#include "mpm/system.hpp"

namespace vitrum {

/// The largest step for which an explicit scheme is stable, and what sets it.
struct CriticalStep {
  double step = 0.0;          ///< s
  double wave_speed = 0.0;    ///< m/s, of the body that sets it
  double travel_speed = 0.0;  ///< m/s, of its fastest particle
  std::string body;
};

/// Steps per h / (c + |v|) that a scheme stands in two dimensions with particles in the worst place (USF,
/// MUSL: 1/sqrt 2) or centred in their cells (USL: 1/2; it has no bound where particles near a cell's edge
/// leave a node nearly empty).
double stability_limit(StepScheme scheme);

/// Of a body's particles, m/s.
double largest_speed(const Particles& particles);

/// limit (steps per h / (c + |v|)) x cell / (wave speed + fastest particle), the least over all bodies.
CriticalStep critical_step(const System& system, double limit);

}  // namespace vitrum
