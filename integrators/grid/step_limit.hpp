#pragma once

namespace vitrum {

/// What kept a step from being longer.
enum class StepLimit {
  fixed,      ///< its length was given
  stability,  ///< the critical step of the method, by the grid
  contact,    ///< the same, by contact that is stiffer than the grid
  accuracy,   ///< the error estimate
  output,     ///< an output, a checkpoint, the end, or that a boundary comes to hold other nodes
  remap,      ///< the end of a Lagrangian phase
};

}  // namespace vitrum
