#pragma once
#include "mpm/system.hpp"

namespace vitrum::mpm {

/// Takes the share 1 - System::flip of what nodes do not see out of the particles' velocities: v - S v, with
/// S v the nodes' velocities interpolated back, before walls hold them. With flip = 0 a step is that of the
/// particle-in-cell method. S keeps the momentum, and as a symmetric operator (in masses) with eigenvalues in
/// [0, 1] it never adds energy; what it removes is booked (StepRecord::filtered). The grid must be that of
/// the particles' positions. Returns whether something has changed.
bool filter_velocities(System& system);

}  // namespace vitrum::mpm
