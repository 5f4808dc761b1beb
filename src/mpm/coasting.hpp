#pragma once
#include "mpm/system.hpp"

/// Bodies that fly, or rest, without strain and far from everything else. All of their particles have the
/// same velocity to the last bit, so that grid and laws would give them back what they have, but for
/// rounding, which grows with every cell that a body crosses. They are kept out of the grid and moved by x +=
/// v dt: exact, and next to no work.
namespace vitrum::mpm {

/// Lets every body coast that may, unless that has been settled before (once a run, or on resuming).
void find_coasting(System& system);
/// Takes up again what a checkpoint says. coasting: by body, 1 where it coasts, else 0.
void restore_coasting(System& system, const std::vector<double>& coasting);
/// Brings the grid up to date and wakes the bodies that would share a node with another one, or meet a node
/// whose prescribed velocity is not theirs. A body that has woken stays awake.
void refresh_grid_and_wake(System& system);
/// Moves the bodies that coast and adds their kinetic energy to the record of the step.
void coast(System& system, double duration);

}  // namespace vitrum::mpm
