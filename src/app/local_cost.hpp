#pragma once
#include "mpm/system.hpp"
#include "scene/scene.hpp"

namespace vitrum::app {

/// What the scene's local method takes for the increments of all particles in one evaluation if none is
/// elastic, s with one thread: measured now, on this machine, in some milliseconds a material, on increments
/// that damage, flow or open. step: s, how long an increment lasts. 0 for the closed form, whose increments
/// particle_steps_a_second (demands.hpp) counts.
double costliest_evaluation(const Scene& scene, const System& system, double step);

}  // namespace vitrum::app
