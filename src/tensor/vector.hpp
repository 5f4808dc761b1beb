#pragma once
#include "tensor/symmetric.hpp"

namespace vitrum {

/// A vector in the plane: components (r, z), or (x, y) in plane strain.
struct PlaneVector {
  double r = 0.0, z = 0.0;

  friend constexpr bool operator==(const PlaneVector&, const PlaneVector&) = default;
};

/// R a
VITRUM_INLINE constexpr PlaneVector rotate(const PlaneVector& a, const Rotation& R) {
  return {R.cosine * a.r - R.sine * a.z, R.sine * a.r + R.cosine * a.z};
}

}  // namespace vitrum
