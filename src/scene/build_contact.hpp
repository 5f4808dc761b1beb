#pragma once
#include "mpm/system.hpp"
#include "scene/scene.hpp"

namespace vitrum {

/// Gives each body a velocity field of its own, and the surfaces contact, where the scene asks for it.
void build_contact(const Scene& scene, System& system);

}  // namespace vitrum
