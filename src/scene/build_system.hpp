#pragma once
#include "mpm/system.hpp"
#include "scene/scene.hpp"

namespace vitrum {

/// Threads that the machine offers, at least 1.
int available_threads();

/// Threads worth using for a number of particles, at most `available`: small scenes lose more to waiting than
/// they gain.
int threads_for(std::size_t particles, int available);

/// Makes the system of a scene: materials, particles, grid, local integrator. threads: 0 chooses by size.
/// Throws InputError for a body whose shape holds no particle, or that reaches across the axis.
System build_system(const Scene& scene, int threads);

}  // namespace vitrum
