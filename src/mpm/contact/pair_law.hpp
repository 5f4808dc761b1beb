#pragma once
#include <algorithm>
#include <cmath>

#include "mpm/contact/patch.hpp"

namespace vitrum::mpm {

/// What two bodies' materials make of the contact between their patches.
struct PairStiffness {
  double stiffness;  ///< Pa/m: pressure per depth of penetration
  double depth;      ///< m, of penetration at which a patch gives way
};

/// What a pair of patches does to each other. Forces and couples are derivatives of the energy, so that what
/// bodies give to contact they get back, and no momentum and no angular momentum is made.
struct PairForce {
  double energy = 0.0;    ///< J (per radian or per metre)
  Vector force{};         ///< N, on b; that on a is the opposite
  double couple_a = 0.0;  ///< N m, counter-clockwise, beyond that of the force at the patch's middle
  double couple_b = 0.0;
  double stiffness = 0.0;  ///< N/m, d2U/dg2 where it is positive
  double pressure = 0.0;   ///< N, of the force along the normal, >= 0: what bounds friction
  double grip = 0.0;       ///< N/m, of the spring along the surface
  Vector normal{};         ///< from a to b
  double gap = 0.0;        ///< m, negative: penetration
  double overlap = 0.0;    ///< share of the patches that lies opposite each other, 0 to 1
};

/// 1 at 0, 0 from 1 on, smooth, and one with its mirror image: hats at the distance of patches sum to 1.
struct Hat {
  double value, slope;
  explicit Hat(double s) {
    s = std::min(s, 1.0);
    value = 1.0 - s * s * (3.0 - 2.0 * s), slope = -6.0 * s * (1.0 - s);
  }
};

/// Potential of a penetration p (in depths), and its derivative: p^2/2, a pressure in proportion, up to half
/// the depth; from there the pressure falls, to 0 at the whole depth, where what has come so far is let
/// through.
struct Barrier {
  double value = 0.0, slope = 0.0, curvature = 0.0;
  explicit Barrier(double p) {
    if (p <= 0.0 || p >= 2.0) return;
    if (p <= 0.5)
      value = 0.5 * p * p, slope = p, curvature = 1.0;
    else if (p < 1.5)
      value = 0.25 - 0.5 * (1.0 - p) * (1.0 - p), slope = 1.0 - p, curvature = -1.0;
    else
      value = 0.5 * (2.0 - p) * (2.0 - p), slope = p - 2.0, curvature = 1.0;
  }
};

/// U = k A S W u(g) of two patches (docs/theory/contact.md): n bisects n_a and -n_b, g = (x_b - x_a).n is the
/// gap, t the offset along the surface, W = hat(|t| / longer length) the overlap, S the facing (1 where the
/// normals are within 53 degrees of opposite), A = (shorter length) x (smaller ring), u = depth^2 barrier(-g
/// / depth).
inline PairForce pair_force(const PlacedPatch& a, const PlacedPatch& b, const PairStiffness& law) {
  PairForce f;
  const Vector d{b.place[0] - a.place[0], b.place[1] - a.place[1]};
  const double opposite = -std::cos(a.angle - b.angle);
  if (opposite <= 0.0) return f;
  // The bisector turns with the mean of the two angles.
  const Vector na{std::cos(a.angle), std::sin(a.angle)}, nb{std::cos(b.angle), std::sin(b.angle)};
  const double size = std::hypot(na[0] - nb[0], na[1] - nb[1]);
  const Vector n{(na[0] - nb[0]) / size, (na[1] - nb[1]) / size}, along{-n[1], n[0]};
  const double gap = dot(d, n), offset = dot(d, along), width = std::max(a.length, b.length);
  f.normal = n, f.gap = gap;
  const Hat overlap(std::abs(offset) / width);
  if (overlap.value <= 0.0) return f;
  constexpr double fully = 0.6;  // cosine from which on patches count as opposite
  const Hat unfacing(opposite / fully);
  const double facing = 1.0 - unfacing.value,
               facing_slope = -unfacing.slope / fully * std::sin(a.angle - b.angle);  // d/d angle_a
  f.overlap = facing * overlap.value;
  const Barrier barrier(-gap / law.depth);
  if (barrier.value <= 0.0) return f;
  const double area = std::min(a.length, b.length) * std::min(a.ring, b.ring),
               kA = law.stiffness * area * law.depth * law.depth;
  f.energy = kA * facing * overlap.value * barrier.value;
  // Derivatives of U to g, t and the angles.
  const double by_gap = -kA * facing * overlap.value * barrier.slope / law.depth,
               by_offset = kA * facing * overlap.slope * std::copysign(1.0, offset) / width * barrier.value,
               by_facing = kA * facing_slope * overlap.value * barrier.value,
               by_turn = 0.5 * (by_gap * offset - by_offset * gap);
  for (std::size_t c = 0; c < 2; ++c) f.force[c] = -(by_gap * n[c] + by_offset * along[c]);
  f.couple_a = -(by_facing + by_turn), f.couple_b = by_facing - by_turn;
  f.pressure = std::max(0.0, -by_gap);
  f.grip = law.stiffness * area * facing * overlap.value;
  f.stiffness = std::max(0.0, f.grip * barrier.curvature);
  return f;
}

/// The same between two particles that no patch stands for: circles of half a particle's side, as faces are
/// that cracks have opened.
inline PairForce pair_force(const Vector& a, const Vector& b, double distance, double area,
                            const PairStiffness& law) {
  PairForce f;
  const Vector d{b[0] - a[0], b[1] - a[1]};
  const double size = std::hypot(d[0], d[1]);
  if (!(size > 0.0)) return f;
  f.normal = {d[0] / size, d[1] / size}, f.gap = size - distance, f.overlap = 1.0;
  const Barrier barrier(-f.gap / law.depth);
  f.energy = law.stiffness * area * law.depth * law.depth * barrier.value;
  f.pressure = std::max(0.0, law.stiffness * area * law.depth * barrier.slope);
  f.grip = law.stiffness * area;
  f.stiffness = std::max(0.0, f.grip * barrier.curvature);
  for (std::size_t c = 0; c < 2; ++c)
    f.force[c] = law.stiffness * area * law.depth * barrier.slope * f.normal[c];
  return f;
}

}  // namespace vitrum::mpm
