#pragma once
#include "integrators/local/path_follower.hpp"

namespace vitrum {

/// Explicit substepping under error control (Sloan, Abbo and Sheng), with the pair of Bogacki and Shampine
/// (orders 3 and 2). Each accepted substep is put back onto the yield surface (drift correction); events are
/// located on the substep that passes them. Stiff modes (ModeEquations::stiff) take the Rosenbrock
/// pair of Shampine and Reichelt (orders 2 and 3) instead: an explicit one would need steps of the relaxation
/// time.
class Substep final : public PathFollower {
 public:
  using PathFollower::PathFollower;

 protected:
  bool solve(const ModeEquations& equations, double* y, Stop& stop, PointReport& report) override;
};

}  // namespace vitrum
