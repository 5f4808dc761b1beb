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

/// 1 where the cosine between a normal and the direction that it faces is above 0.6, 0 from 0 down.
inline Hat facing(double cosine) {
  constexpr double fully = 0.6;
  const Hat unfacing(std::max(0.0, cosine) / fully);
  Hat facing = unfacing;
  facing.value = 1.0 - unfacing.value, facing.slope = -unfacing.slope / fully;
  return facing;
}

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

/// U = k A S W u(g) of two patches (docs/theory/contact.md): n is the mean of n_a and -n_b, each weighted by
/// the other's curvature, as the line through the centres of two circles is, so that what is round or sharp
/// meets a plane along the plane's normal. g = (x_b - x_a).n is the gap, t the offset along the surface, W =
/// hat(|t| / longer length) the overlap, S the facing (1 where the normals are within 53 degrees of
/// opposite), A = (shorter length) x (smaller ring), u = depth^2 barrier(-g / depth).
inline PairForce pair_force(const PlacedPatch& a, const PlacedPatch& b, const PairStiffness& law) {
  PairForce f;
  const Vector d{b.place[0] - a.place[0], b.place[1] - a.place[1]};
  const double opposite = -std::cos(a.angle - b.angle);
  if (opposite <= 0.0) return f;
  const double curved = a.curvature + b.curvature, weight_a = curved > 0.0 ? b.curvature / curved : 0.5,
               weight_b = 1.0 - weight_a;
  const Vector na{std::cos(a.angle), std::sin(a.angle)}, nb{std::cos(b.angle), std::sin(b.angle)},
      mean{weight_a * na[0] - weight_b * nb[0], weight_a * na[1] - weight_b * nb[1]};
  const double size = std::hypot(mean[0], mean[1]);
  const Vector n{mean[0] / size, mean[1] / size}, along{-n[1], n[0]};
  // The share of a's turn by which the normal turns; that of b's is the rest.
  const double share_a = weight_a * (weight_a + weight_b * opposite) / (size * size);
  const double gap = dot(d, n), offset = dot(d, along), width = std::max(a.length, b.length);
  f.normal = n, f.gap = gap;
  const Hat overlap(std::abs(offset) / width);
  if (overlap.value <= 0.0) return f;
  const Hat faces = facing(opposite);
  f.overlap = faces.value * overlap.value;
  const Barrier barrier(-gap / law.depth);
  if (barrier.value <= 0.0) return f;
  const double area = std::min(a.length, b.length) * std::min(a.ring, b.ring),
               kA = law.stiffness * area * law.depth * law.depth;
  f.energy = kA * f.overlap * barrier.value;
  // Derivatives of U to g, t and the angles.
  const double by_gap = -kA * f.overlap * barrier.slope / law.depth,
               by_offset =
                   kA * faces.value * overlap.slope * std::copysign(1.0, offset) / width * barrier.value,
               by_facing = kA * faces.slope * std::sin(a.angle - b.angle) * overlap.value * barrier.value,
               by_turn = by_gap * offset - by_offset * gap;  // of the normal
  for (std::size_t c = 0; c < 2; ++c) f.force[c] = -(by_gap * n[c] + by_offset * along[c]);
  f.couple_a = -by_facing - share_a * by_turn, f.couple_b = by_facing - (1.0 - share_a) * by_turn;
  f.pressure = std::max(0.0, -by_gap);
  f.grip = law.stiffness * area * f.overlap;
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
