#pragma once
#include <vector>

#include "mpm/system.hpp"

namespace vitrum {

/// What a search for equilibrium came to.
struct Relaxation {
  int iterations = 0;
  double residual = 0.0;  ///< energy that the forces left could release, relative to the energy stored
};

/// Brings the stress of bodies into equilibrium under the loads of the present where they stand: strains that
/// displacements of the nodes would make are added to theirs, by Newton's iteration, the implicit method
/// without its inertia. Nothing moves, turns, flows or breaks on the way. Without loads the stress is the
/// nearest of all that are in equilibrium to the one given, in the energy of its difference. A body that is
/// free to move as a whole is held back by a trace of inertia, which vanishes with the forces. relaxed: by
/// body; the others are taken off the grid meanwhile. Throws ComputationError where it does not converge:
/// forces that no stress can bear.
Relaxation relax(System& system, const std::vector<bool>& relaxed);

}  // namespace vitrum
