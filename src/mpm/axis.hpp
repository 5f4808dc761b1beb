#pragma once
#include "mpm/particles.hpp"

namespace vitrum::mpm {

/// A particle that crosses the axis changes places with its image, whose odd components have the other sign.
/// The position is not touched.
inline void reflect_at_axis(Particles& p, std::size_t i) {
  const auto flip = [i](std::vector<double>& column) {
    if (!column.empty()) column[i] = -column[i];
  };
  flip(p.velocity[0]), flip(p.elastic_strain[3]);
  flip(p.strain_increment[3]), flip(p.spin_increment);
  for (const std::size_t k : p.flipping) flip(p.variables[k]);
  flip(p.turn), flip(p.mirrored), flip(p.stretch[2]);
}

}  // namespace vitrum::mpm
