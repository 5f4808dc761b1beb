#pragma once
#include "mpm/system.hpp"

namespace vitrum::mpm {

/// What carry_held has done.
struct Carried {
  double work = 0.0;     ///< kinetic energy that the particles have gained, J (per radian or per metre)
  bool changed = false;  ///< some velocity is another
};

/// Gives particles the velocity with which they move wherever that does not depend on anything: a component
/// in which all nodes that a particle touches are held becomes sum N v of the prescribed velocities. (Forces
/// on these nodes change nothing, so that the particle would keep for ever what it brought along. Where some
/// node is free, nothing is imposed: projection would make that a drag at every step.) For lists of particles
/// that are up to date. slack: m/s; a particle that moves with driven nodes but for so much is left, since it
/// follows them by their acceleration.
Carried carry_held(System& system, double slack = 0.0);

}  // namespace vitrum::mpm
