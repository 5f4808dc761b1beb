#pragma once
#include <algorithm>
#include <cmath>

/// For the few functions that loops over particles are made of: a loop with a call in it is not vectorised.
#define VITRUM_INLINE [[gnu::always_inline]] inline

namespace vitrum {

/// Symmetric second-order tensor with one symmetry plane: components (rr, zz, tt, rz) in the axisymmetric
/// frame (r, z, theta), or (xx, yy, zz, xy) in plane strain. `rz` is the tensor component (half the
/// engineering shear).
struct SymmetricTensor {
  double rr = 0.0, zz = 0.0, tt = 0.0, rz = 0.0;

  constexpr SymmetricTensor& operator+=(const SymmetricTensor& o) {
    rr += o.rr, zz += o.zz, tt += o.tt, rz += o.rz;
    return *this;
  }
  constexpr SymmetricTensor& operator-=(const SymmetricTensor& o) {
    rr -= o.rr, zz -= o.zz, tt -= o.tt, rz -= o.rz;
    return *this;
  }
  constexpr SymmetricTensor& operator*=(double f) {
    rr *= f, zz *= f, tt *= f, rz *= f;
    return *this;
  }
  friend constexpr SymmetricTensor operator+(SymmetricTensor a, const SymmetricTensor& b) { return a += b; }
  friend constexpr SymmetricTensor operator-(SymmetricTensor a, const SymmetricTensor& b) { return a -= b; }
  friend constexpr SymmetricTensor operator*(double f, SymmetricTensor a) { return a *= f; }
  friend constexpr bool operator==(const SymmetricTensor&, const SymmetricTensor&) = default;
};

constexpr SymmetricTensor identity() {
  return {1.0, 1.0, 1.0, 0.0};
}
VITRUM_INLINE constexpr double trace(const SymmetricTensor& a) {
  return a.rr + a.zz + a.tt;
}
VITRUM_INLINE constexpr SymmetricTensor deviator(const SymmetricTensor& a) {
  const double mean = (1.0 / 3.0) * trace(a);
  return {a.rr - mean, a.zz - mean, a.tt - mean, a.rz};
}
/// a : b
VITRUM_INLINE constexpr double contract(const SymmetricTensor& a, const SymmetricTensor& b) {
  return a.rr * b.rr + a.zz * b.zz + a.tt * b.tt + 2.0 * a.rz * b.rz;
}
VITRUM_INLINE double norm(const SymmetricTensor& a) {
  return std::sqrt(contract(a, a));
}

/// Rotation in the r-z plane by an angle, counter-clockwise from r to z.
struct Rotation {
  double cosine = 1.0, sine = 0.0;
};

/// Rotation by an angle (rad) of the size that a time step makes: a series, exact to rounding up to
/// small_angle.
inline constexpr double small_angle = 0.05;
VITRUM_INLINE constexpr Rotation rotation_by_small(double angle) {
  const double a = angle * angle;
  return {1.0 - a * (1.0 / 2.0 - a * (1.0 / 24.0 - a * (1.0 / 720.0 - a * (1.0 / 40320.0)))),
          angle * (1.0 - a * (1.0 / 6.0 - a * (1.0 / 120.0 - a * (1.0 / 5040.0 - a * (1.0 / 362880.0)))))};
}

/// Rotation by `angle` (rad).
inline Rotation rotation_by(double angle) {
  if (std::abs(angle) > small_angle) return {std::cos(angle), std::sin(angle)};
  return rotation_by_small(angle);
}

/// R a R^T
VITRUM_INLINE constexpr SymmetricTensor rotate(const SymmetricTensor& a, const Rotation& R) {
  const double c = R.cosine, s = R.sine, cc = c * c, ss = s * s, cs = c * s;
  return {cc * a.rr + ss * a.zz - 2.0 * cs * a.rz, ss * a.rr + cc * a.zz + 2.0 * cs * a.rz, a.tt,
          cs * (a.rr - a.zz) + (cc - ss) * a.rz};
}

/// In-plane principal values and the unit vector (r, z) of the larger one.
struct InPlanePrincipal {
  double major, minor;
  double direction_r, direction_z;
};

inline InPlanePrincipal in_plane_principal(const SymmetricTensor& a) {
  const double centre = 0.5 * (a.rr + a.zz), half = 0.5 * (a.rr - a.zz);
  const double radius = std::hypot(half, a.rz);
  const double angle = 0.5 * std::atan2(a.rz, half);
  return {centre + radius, centre - radius, std::cos(angle), std::sin(angle)};
}

/// Largest principal value; the hoop direction is always principal.
inline double largest_principal(const SymmetricTensor& a) {
  return std::max(in_plane_principal(a).major, a.tt);
}

}  // namespace vitrum
