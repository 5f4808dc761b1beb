#pragma once
#include <array>

#include "mpm/system.hpp"

namespace vitrum {

/// When a Lagrangian phase ends.
struct RemapSettings {
  double duration;       ///< s, at most; may be infinite
  double travel = 0.25;  ///< cells that a particle may move
  double strain = 0.02;  ///< that a particle may strain, or turn (rad)
};

/// What the state of the present allows a phase.
struct PhaseBounds {
  double duration;      ///< s; infinite where nothing moves
  double way_at_walls;  ///< cells that nodes near held ones may go; infinite where no body is about to meet
                        ///< or to leave them
};
/// Once the phase has begun: of the nodes that boundaries hold in it.
PhaseBounds phase_bounds(const System& system, const RemapSettings& remap);

/// Cells from a place (cells from the origin) to the nodes that a boundary holds; infinite: it holds none.
double cells_to_held(const mpm::Grid& grid, std::size_t boundary, const std::array<double, 2>& place);

}  // namespace vitrum
