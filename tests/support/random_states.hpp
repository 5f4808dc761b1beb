#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "tensor/symmetric.hpp"

namespace vitrum::test {

/// Random numbers that are the same with every standard library (the distributions of <random> are not).
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}

  /// Uniform in [low, high).
  double uniform(double low, double high) {
    return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1.0p-53);
  }
  /// Log-uniform in [low, high).
  double logarithmic(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  int integer(int low, int high) {  // both ends included
    return low + static_cast<int>(uniform(0.0, static_cast<double>(high - low + 1)));
  }
  bool chance(double probability) { return uniform(0.0, 1.0) < probability; }

  /// Components independent in [-size, size).
  SymmetricTensor tensor(double size) {
    const double rr = uniform(-size, size), zz = uniform(-size, size), tt = uniform(-size, size);
    return {rr, zz, tt, uniform(-size, size)};
  }
  /// Unit norm; principal values uniform on the sphere, axes turned at random in the r-z plane.
  SymmetricTensor direction() {
    const double height = uniform(-1.0, 1.0), azimuth = uniform(0.0, 2.0 * std::numbers::pi);
    const double radius = std::sqrt(1.0 - height * height);
    const double angle = uniform(0.0, std::numbers::pi);
    const SymmetricTensor principal{radius * std::cos(azimuth), radius * std::sin(azimuth), height, 0.0};
    return rotate(principal, {std::cos(angle), std::sin(angle)});
  }
  SymmetricTensor deviatoric_direction() {
    for (;;) {
      const SymmetricTensor d = deviator(direction());
      if (const double size = norm(d); size > 0.1) return (1.0 / size) * d;
    }
  }

 private:
  std::mt19937_64 engine_;
};

}  // namespace vitrum::test
