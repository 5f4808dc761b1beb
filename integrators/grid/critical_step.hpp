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
  std::string touching = "";  ///< the body whose contact with it is stiffer than the grid; empty: none
};

/// Steps per h / (c + |v|) that a scheme stands in two dimensions with particles in the worst place (USF,
/// MUSL: 1/sqrt 2) or centred in their cells (USL: 1/2; it has no bound where particles near a cell's edge
/// leave a node nearly empty).
double stability_limit(StepScheme scheme);

/// Of a body's particles, m/s.
double largest_speed(const Particles& particles);

/// The speed c + |v| at which the grid is as stiff as contact, m/s: its frequencies are at most 2 sqrt(2)
/// (c + |v|) / h, contact's squares at most frequency_squared (1/s^2).
double speed_as_stiff(double frequency_squared, double cell);

/// Which pairs of bodies are counted as touching: those that may within a step, or all.
enum class Touching { soon, any };
/// Whose speeds are counted.
enum class Speeds { of_waves_and_particles, of_waves };

/// limit (steps per h / (c + |v|)) x cell / (wave speed + fastest particle), the least over all bodies; the
/// same for contact of the bodies that touch. (Squares of frequencies add up at worst: 1/sqrt(2) of this step
/// is stable for both together.)
CriticalStep critical_step(const System& system, double limit, Touching touching = Touching::soon,
                           Speeds speeds = Speeds::of_waves_and_particles);

}  // namespace vitrum
