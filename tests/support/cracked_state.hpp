#pragma once
#include <cmath>

#include "support/material_samples.hpp"

namespace vitrum::test {

/// Elastic glass with a plane that softens; no damage and no yield, so that nothing else happens.
inline MaterialParameters cohesive_glass(double opening, double mode_ratio = 1.0, double q = 1.0,
                                         double viscosity = 0.0) {
  MaterialParameters p = bare_glass();
  p.decohesion = DecohesionParameters{opening, q, mode_ratio, viscosity, false};
  return p;
}

/// n (x) n, and the symmetric n (x) t with n:d:t for unit shear, in components; n at `angle` from r, t = n
/// turned by +90 degrees.
inline SymmetricTensor normal_dyad(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {c * c, s * s, 0.0, c * s};
}
inline SymmetricTensor shear_dyad(double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return {-c * s, c * s, 0.0, 0.5 * (c * c - s * s)};
}
inline double normal_traction(const SymmetricTensor& stress, double angle) {
  return contract(stress, normal_dyad(angle));
}
inline double tangential_traction(const SymmetricTensor& stress, double angle) {
  return contract(stress, shear_dyad(angle));
}

/// A point at the onset of decohesion on the plane at `angle`: strength `strength` (Pa), stress as given.
inline CompositeState at_onset(const CompositeMaterial& material, double angle, double strength,
                               const SymmetricTensor& stress, double length = cell) {
  CompositeState s = material.initial_state(stress);
  s.normal.r = std::cos(angle);
  s.normal.z = std::sin(angle);
  s.effective_length = length;
  s.cohesive_strength = strength;
  return s;
}

}  // namespace vitrum::test
