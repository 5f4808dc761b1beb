#pragma once
#include <vector>

#include "mpm/system.hpp"

namespace vitrum {

/// What a search for equilibrium came to.
struct Relaxation {
  int iterations = 0;
  double residual = 0.0;  ///< energy that the forces left could release, relative to the energy stored
};

/// Brings bodies into equilibrium under the loads of the present by Newton's iteration over nodal
/// displacements, the implicit method without its inertia: particles move, strain elastically and turn; no
/// law flows or breaks on the way, and velocities stay. Held nodes stay where they are. A body that is free
/// to move as a whole is held back by a trace of inertia, which vanishes with the forces. relaxed: by body;
/// the others are taken off the grid meanwhile. Throws ComputationError where it does not converge: forces
/// that no body can bear.
Relaxation relax(System& system, const std::vector<bool>& relaxed);

}  // namespace vitrum
