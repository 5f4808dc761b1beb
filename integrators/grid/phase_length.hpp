#pragma once
#include "mpm/system.hpp"

namespace vitrum {

/// When a Lagrangian phase ends.
struct RemapSettings {
  double duration;       ///< s, at most; may be infinite
  double travel = 0.25;  ///< cells that a particle may move
  double strain = 0.02;  ///< that a particle may strain, or turn (rad)
};

/// The longest phase that the state of the present allows, s; infinite where nothing moves.
double longest_phase(const System& system, const RemapSettings& remap);

}  // namespace vitrum
