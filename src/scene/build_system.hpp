#pragma once
#include "mpm/system.hpp"
#include "scene/scene.hpp"

namespace vitrum {

/// Makes the system of a scene: materials, particles, grid, local integrator. threads: 0 chooses by size.
/// Throws InputError for a body whose shape holds no particle, or that reaches across the axis.
System build_system(const Scene& scene, int threads);

}  // namespace vitrum
