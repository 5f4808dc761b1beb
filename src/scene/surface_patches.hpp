#pragma once
#include <vector>

#include "mpm/contact/patch.hpp"
#include "mpm/particles.hpp"
#include "scene/scene.hpp"

namespace vitrum {

/// The surface of a region in pieces of about one particle spacing, each carried by the body's nearest
/// particle (mpm/contact). On the axis there is no surface.
std::vector<mpm::Patch> surface_patches(const Region& region, Geometry geometry, const Body& body);

}  // namespace vitrum
