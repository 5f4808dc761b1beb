#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace vitrum::test {

using TangentMatrix =
    std::array<std::array<double, 4>, 4>;  // stress <- strain, order (rr, zz, tt, rz), tensor shear

/// Determinant of the in-plane 2 x 2 block of n.T.n for n = (cos angle, sin angle). The out-of-plane entry of
/// the acoustic tensor is a positive shear modulus that only scales the full determinant.
inline double acoustic_determinant(const TangentMatrix& T, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  // A jump of the strain rate sym(n x g): the stress it makes, times n.
  const auto traction = [&](double gr, double gz) {
    const std::array<double, 4> e{c * gr, s * gz, 0.0, 0.5 * (c * gz + s * gr)};
    std::array<double, 4> stress{};
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) stress[i] += T[i][j] * e[j];
    return std::array<double, 2>{stress[0] * c + stress[3] * s, stress[3] * c + stress[1] * s};
  };
  const auto a = traction(1.0, 0.0), b = traction(0.0, 1.0);
  return a[0] * b[1] - a[1] * b[0];
}

/// n.T.n for the hoop normal, its only entry that is not a shear modulus.
inline double hoop_acoustic(const TangentMatrix& T) {
  return T[2][2];
}

struct ScannedPlane {
  double determinant;
  double angle;  // of the normal, rad in [0, pi)
};

/// Least determinant over in-plane normals: `samples` angles, then golden section around the best.
inline ScannedPlane scan_normals(const TangentMatrix& T, int samples) {
  const double spacing = std::numbers::pi / samples;
  ScannedPlane best{std::numeric_limits<double>::infinity(), 0.0};
  for (int i = 0; i < samples; ++i)
    if (const double d = acoustic_determinant(T, i * spacing); d < best.determinant) best = {d, i * spacing};
  double low = best.angle - spacing, high = best.angle + spacing;
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  double a = high - golden * (high - low), b = low + golden * (high - low);
  double fa = acoustic_determinant(T, a), fb = acoustic_determinant(T, b);
  for (int i = 0; i < 32; ++i) {
    if (fa < fb) {
      high = b, b = a, fb = fa;
      a = high - golden * (high - low), fa = acoustic_determinant(T, a);
    } else {
      low = a, a = b, fa = fb;
      b = low + golden * (high - low), fb = acoustic_determinant(T, b);
    }
  }
  return {std::min(fa, fb), 0.5 * (low + high)};
}

/// Angle between two axes (not directions), rad in [0, pi/2].
inline double axis_difference(double a, double b) {
  const double d = std::abs(std::remainder(a - b, std::numbers::pi));
  return d;
}

}  // namespace vitrum::test
