#pragma once
#include <array>
#include <cmath>
#include <complex>

#include "tensor/symmetric.hpp"

namespace vitrum::test {

/// Eqs. 4-8 as the paper prints them, for real and complex arguments (complex: derivatives free of
/// cancellation).
struct LiteralDamage {
  double young, poisson, density, toughness, k, m;

  double coefficient(double rate) const {
    const double c = std::sqrt(young / density);
    return 2.5 * k * std::pow(toughness / (density * c * rate), 2.0);
  }
  double bulk() const { return young / (3.0 * (1.0 - 2.0 * poisson)); }

  template <class T>
  struct LiteralModuli {
    T damage, poisson, bulk, shear;
  };
  template <class T>
  LiteralModuli<T> moduli(T crack_density) const {
    const T nu = poisson * (1.0 - 16.0 / 9.0 * crack_density);
    const T damage = 16.0 * crack_density * (1.0 - nu * nu) / (9.0 * (1.0 - 2.0 * nu));
    const T bulk_damaged = (1.0 - damage) * bulk();
    return {damage, nu, bulk_damaged, 1.5 * bulk_damaged * (1.0 - 2.0 * nu) / (1.0 + nu)};
  }

  template <class T>
  using Components = std::array<T, 4>;  // rr, zz, tt, rz

  /// Stress while damage grows at a constant rate: sigma = E(C eps_v^m) : e.
  template <class T>
  Components<T> growing_stress(const Components<T>& e, double coefficient_of_rate) const {
    const T trace = e[0] + e[1] + e[2];
    const auto now = moduli<T>(coefficient_of_rate * std::pow(trace / 3.0, m));
    const T lame = (now.bulk - 2.0 / 3.0 * now.shear) * trace;
    return {lame + 2.0 * now.shear * e[0], lame + 2.0 * now.shear * e[1], lame + 2.0 * now.shear * e[2],
            2.0 * now.shear * e[3]};
  }

  using Matrix = std::array<std::array<double, 4>, 4>;  // [stress component][strain component], tensor shear
  /// d(growing_stress)/d(strain) by complex steps.
  Matrix tangent(const SymmetricTensor& strain, double coefficient_of_rate) const {
    using Z = std::complex<double>;
    constexpr double h = 1e-30;
    Matrix T{};
    for (std::size_t j = 0; j < 4; ++j) {
      Components<Z> e{Z(strain.rr), Z(strain.zz), Z(strain.tt), Z(strain.rz)};
      e[j] += Z(0.0, h);
      const auto s = growing_stress<Z>(e, coefficient_of_rate);
      for (std::size_t i = 0; i < 4; ++i) T[i][j] = s[i].imag() / h;
    }
    return T;
  }
};

inline LiteralDamage literal_glass() {
  return {72.0e9, 0.25, 2500.0, 0.83e6, 5.0e26, 6.0};
}

}  // namespace vitrum::test
