#pragma once
#include "mpm/particles.hpp"
#include "scene/scene.hpp"

namespace vitrum {

/// Throws InputError when what a body's particles are computed with leaves the range of numbers, or what is
/// made of it by products would (masses that vanish, energies that are infinite): with the body, the quantity
/// and its value. `index`: of the body in the scene.
void require_range(const Scene& scene, std::size_t index, const Body& body);

}  // namespace vitrum
