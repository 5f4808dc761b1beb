#pragma once
#include <cmath>

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
constexpr double trace(const SymmetricTensor& a) {
  return a.rr + a.zz + a.tt;
}
constexpr SymmetricTensor deviator(const SymmetricTensor& a) {
  const double mean = trace(a) / 3.0;
  return {a.rr - mean, a.zz - mean, a.tt - mean, a.rz};
}
/// a : b
constexpr double contract(const SymmetricTensor& a, const SymmetricTensor& b) {
  return a.rr * b.rr + a.zz * b.zz + a.tt * b.tt + 2.0 * a.rz * b.rz;
}
inline double norm(const SymmetricTensor& a) {
  return std::sqrt(contract(a, a));
}

/// Rotation in the r-z plane by an angle, counter-clockwise from r to z.
struct Rotation {
  double cosine = 1.0, sine = 0.0;
};

/// Rotation by `angle` (rad). Series for the small angles of a time step: exact to rounding below 0.05 rad.
inline Rotation rotation_by(double angle) {
  if (std::abs(angle) > 0.05) return {std::cos(angle), std::sin(angle)};
  const double a = angle * angle;
  return {1.0 - a / 2.0 * (1.0 - a / 12.0 * (1.0 - a / 30.0 * (1.0 - a / 56.0))),
          angle * (1.0 - a / 6.0 * (1.0 - a / 20.0 * (1.0 - a / 42.0 * (1.0 - a / 72.0))))};
}

/// R a R^T
constexpr SymmetricTensor rotate(const SymmetricTensor& a, const Rotation& R) {
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

}  // namespace vitrum
