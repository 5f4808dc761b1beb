#pragma once
#include <array>
#include <cmath>

#include "tensor/symmetric.hpp"

namespace vitrum::mpm {

/// Strain and turn of a finite deformation in the r-z plane with the hoop (or none): F = R U by its
/// displacement gradient, e = U - I, and the hoop strain u_r / r. Exact for any rotation. Also the stress
/// that is conjugate to F, so that forces from it are the derivative of the energy stored as a function of e.
class FiniteStrain {
 public:
  /// gradient: (rr, rz, zr, zz, tt), du_i/dx_j and u_r / r.
  explicit FiniteStrain(const std::array<double, 5>& g) {
    a_ = 2.0 + g[0] + g[3], b_ = g[2] - g[1];
    size_ = std::hypot(a_, b_);
    cosine_ = a_ / size_, sine_ = b_ / size_;
    const double fall = a_ > 0.0 ? -b_ * b_ / (size_ * (a_ + size_)) : cosine_ - 1.0;  // cosine - 1
    e_ = {fall + cosine_ * g[0] + sine_ * g[2], fall + cosine_ * g[3] - sine_ * g[1], g[4],
          0.5 * (cosine_ * (g[1] + g[2]) + sine_ * (g[3] - g[0]))};
  }

  const SymmetricTensor& strain() const { return e_; }
  /// rad, counter-clockwise from r to z.
  double turn() const { return std::atan2(b_, a_); }

  /// Nominal stress P with P : dF = stress : de for every dF. Components (rr, rz, zr, zz); the hoop's is
  /// stress.tt.
  std::array<double, 4> nominal(const SymmetricTensor& s) const {
    // de contains dF also through the turn: its part there is the work of stress on the commutator with U.
    const double of_turn = (s.rr - s.zz) * e_.rz + s.rz * (e_.zz - e_.rr);
    const double along = of_turn * a_ / (size_ * size_), across = of_turn * b_ / (size_ * size_);
    return {cosine_ * s.rr - sine_ * s.rz - across, cosine_ * s.rz - sine_ * s.zz - along,
            sine_ * s.rr + cosine_ * s.rz + along, sine_ * s.rz + cosine_ * s.zz - across};
  }

  /// de for a small change of the gradient (rr, rz, zr, zz, tt).
  SymmetricTensor change(const std::array<double, 5>& d) const {
    const double turned = (a_ * (d[2] - d[1]) - b_ * (d[0] + d[3])) / (size_ * size_);
    return {cosine_ * d[0] + sine_ * d[2] + turned * e_.rz, cosine_ * d[3] - sine_ * d[1] - turned * e_.rz,
            d[4], 0.5 * (cosine_ * (d[1] + d[2]) + sine_ * (d[3] - d[0]) + turned * (e_.zz - e_.rr))};
  }

 private:
  double a_, b_, size_, cosine_, sine_;
  SymmetricTensor e_;
};

}  // namespace vitrum::mpm
