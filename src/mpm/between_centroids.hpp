#pragma once
#include <array>

#include "tensor/symmetric.hpp"

namespace vitrum::mpm {

/// The gradient of a velocity field that nodes have collected from particles. A node's velocity is that of
/// the centroid of what it collected, not of its own place: at the edge of a body the two differ by up to a
/// cell, and the plain gradient G of a linear field A is not A but A H, H being the gradient of the
/// centroids. Of all L with L H = G the one is taken that strains least:
///   |L H - G|^2 + a |sym L|^2 -> min,  a = 0.1 (1 - det H)^2 where det H < 1, else 0,
/// so that a rigid motion of any cloud, one particle thick or of two particles, has no strain, any linear
/// field is exact where H is 1, and nearly so where H is not nearly singular; a keeps frequencies below those
/// that hold for plain gradients anyway.
class BetweenCentroids {
 public:
  /// A 2 x 2 matrix by rows: dv_r/dr, dv_r/dz, dv_z/dr, dv_z/dz.
  using Matrix = std::array<double, 4>;

  VITRUM_INLINE explicit BetweenCentroids(const Matrix& centroids) : h_(centroids) {
    const auto [a, b, c, d] = h_;
    const double missing = 1.0 - (a * d - b * c), some = missing > 0.0 ? missing : 0.0;
    weight_ = 0.1 * some * some;
    p_ = a * a + b * b + least, q_ = a * c + b * d, r_ = c * c + d * d + least;
    per_rr_ = 1.0 / (p_ + weight_), per_zz_ = 1.0 / (r_ + weight_);
    along_ = r_ - q_ * q_ * per_rr_, across_ = p_ - q_ * q_ * per_zz_;
    per_determinant_ = 1.0 / (along_ * across_ + 0.5 * weight_ * (along_ + across_));
  }

  /// L of the plain gradient G.
  VITRUM_INLINE Matrix gradient(const Matrix& g) const {
    const auto [a, b, c, d] = h_;
    return solve({g[0] * a + g[1] * b, g[0] * c + g[1] * d, g[2] * a + g[3] * b, g[2] * c + g[3] * d});
  }
  /// The stress Q whose power on G is that of P on L, for every G: forces are made of Q.
  VITRUM_INLINE Matrix stress(const Matrix& p) const {
    const auto [a, b, c, d] = h_;
    const Matrix y = solve(p);
    return {y[0] * a + y[1] * c, y[0] * b + y[1] * d, y[2] * a + y[3] * c, y[2] * b + y[3] * d};
  }

 private:
  /// Added to H H^T: where a particle is alone, H and G are rounding, and L is to be 0.
  static constexpr double least = 1e-12;

  /// Solves L H H^T + a sym L = b; the operator is its own transpose.
  VITRUM_INLINE Matrix solve(const Matrix& b) const {
    const double rz = b[1] - q_ * b[0] * per_rr_, zr = b[2] - q_ * b[3] * per_zz_, half = 0.5 * weight_;
    const double l_rz = ((across_ + half) * rz - half * zr) * per_determinant_,
                 l_zr = ((along_ + half) * zr - half * rz) * per_determinant_;
    return {(b[0] - q_ * l_rz) * per_rr_, l_rz, l_zr, (b[3] - q_ * l_zr) * per_zz_};
  }

  Matrix h_;
  double weight_, p_, q_, r_, per_rr_, per_zz_, along_, across_, per_determinant_;
};

}  // namespace vitrum::mpm
