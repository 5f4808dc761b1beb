#pragma once
#include "mpm/system.hpp"
#include "scene/scene.hpp"

namespace vitrum {

/// Lays the scene's tractions on the surfaces of the system's bodies. Throws InputError where a box holds
/// nothing of its body's surface.
void build_tractions(const Scene& scene, System& system);

}  // namespace vitrum
