#pragma once
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace vitrum::mpm {

using Vector = std::array<double, 2>;

inline Vector difference(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1]};
}
inline double dot(const Vector& a, const Vector& b) {
  return a[0] * b[0] + a[1] * b[1];
}
/// Out of plane, counter-clockwise from r to z.
inline double cross(const Vector& a, const Vector& b) {
  return a[0] * b[1] - a[1] * b[0];
}

/// A piece of a body's exact surface, one particle spacing long, that the nearest particle carries: it moves
/// and turns with that particle. Patches know no neighbours, so that a surface may break anywhere.
struct Patch {
  std::uint32_t carrier;  ///< identity of the particle
  Vector offset;          ///< m, from the particle's place to the patch's middle, at the start
  double angle;           ///< rad, of the outward normal, counter-clockwise from r, at the start
  double length;          ///< m, along the surface
  double ring;  ///< area of a ring per length and radian: the radius at the start, m; 1 in plane strain
  double curvature = 0.0;  ///< 1/m, of the surface about it, corners included, at the start
};

/// The particles that carry two patches of different bodies.
struct CarrierPair {
  std::size_t body_a, particle_a, body_b, particle_b;
};

/// A patch where its carrier has taken it.
struct PlacedPatch {
  Vector place;   ///< m
  Vector arm;     ///< m, from the carrier
  double angle;   ///< rad
  double length;  ///< m
  double ring;    ///< as Patch
  double curvature = 0.0;
};

}  // namespace vitrum::mpm
