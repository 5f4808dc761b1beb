#pragma once
#include "mpm/system.hpp"

namespace vitrum::mpm {

/// Finds, for the particles where they are, the centroids of what nodes collect and their gradient at every
/// particle (Particles::centroids; between_centroids.hpp), which gradients and forces take account of from
/// then on. Interpolated velocities are those of the interpolated centroids, a little inward at the edge of a
/// body; particles move as if fixed to them, so that a body that turns keeps its shape. Does nothing where
/// the system takes gradients between nodes. For lists of particles that are up to date.
void find_centroids(System& system);

}  // namespace vitrum::mpm
