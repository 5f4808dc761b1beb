#pragma once
#include <algorithm>
#include <cmath>
#include <span>

#include "materials/elasticity.hpp"
#include "schema/fields.hpp"

namespace vitrum {

/// Scene table [material.NAME.damage]: rate-dependent tensile damage, eqs. 4-9.
struct DamageParameters {
  double toughness = 0.0;   ///< K_IC, Pa sqrt(m)
  double k = 0.0;           ///< 1/m^3
  double m = 0.0;           ///< exponent of eq. 7
  double rate_floor = 1.0;  ///< 1/s, least rate that enters eq. 7
  double fixed_rate = 0.0;  ///< 1/s; > 0: this rate enters eq. 7 instead of the running maximum

  static schema::Fields<DamageParameters> rows();
};

/// Crack density at which the material has lost all tensile stiffness (x = 1).
inline constexpr double crack_density_limit = 9.0 / 16.0;

/// The law of eqs. 4-8 for one material, in terms of x = 16 rho_d / 9 in [0, 1]. Pure functions.
class DamageLaw {
 public:
  DamageLaw() = default;
  DamageLaw(const DamageParameters& parameters, const ElasticParameters& elastic);

  /// Damaged moduli, eqs. 5, 6, 8; written without the cancellation of 1 - D.
  VITRUM_INLINE Moduli moduli(double x) const {
    const double nu_bar = poisson_ * (1.0 - x);
    const double common = undamaged_.bulk * (1.0 - x) * weight(x);
    return {common / (1.0 - 2.0 * nu_bar), 1.5 * common / (1.0 + nu_bar)};
  }

  /// d(moduli)/dx.
  Moduli moduli_derivative(double x) const {
    const double nu = poisson_, nu_bar = nu * (1.0 - x), w = weight(x), K = undamaged_.bulk;
    const double slope = -w + (1.0 - x) * nu * nu * (1.0 - 2.0 * x);
    const double a = 1.0 - 2.0 * nu_bar, b = 1.0 + nu_bar;
    return {K * (slope / a - 2.0 * nu * (1.0 - x) * w / (a * a)),
            1.5 * K * (slope / b + nu * (1.0 - x) * w / (b * b))};
  }

  /// D = 1 - K_bar/K, eq. 8.
  double damage(double x) const { return 1.0 - moduli(x).bulk / undamaged_.bulk; }

  /// The rate that enters eq. 7 when the running maximum is `max_rate`, 1/s.
  VITRUM_INLINE double effective_rate(double max_rate) const {
    return parameters_.fixed_rate > 0.0 ? parameters_.fixed_rate : std::max(max_rate, parameters_.rate_floor);
  }
  /// C(R) of rho_d = C eps_v^m (eq. 7). rate: 1/s, > 0.
  VITRUM_INLINE double coefficient(double rate) const { return coefficient_at_unit_rate_ / (rate * rate); }

  /// Crack density of eq. 7 at mean strain eps_v = tr(e)/3, capped at 9/16; 0 where eps_v <= 0.
  double target(double mean_strain, double coefficient) const {
    if (mean_strain <= 0.0) return 0.0;
    return std::min(coefficient * power(mean_strain), crack_density_limit);
  }
  /// Multiplies `result` with the m-th powers of `values`, which it uses up: v^m to the bit of `target`, for
  /// several at a time.
  void raise(double* values, double* result, std::size_t size) const {
    if (integer_exponent_ == 0)
      for (std::size_t k = 0; k < size; ++k) result[k] *= std::pow(values[k], parameters_.m);
    for (unsigned n = integer_exponent_; n != 0; n >>= 1) {
      if (n & 1U)
        for (std::size_t k = 0; k < size; ++k) result[k] *= values[k];
      for (std::size_t k = 0; k < size; ++k) values[k] *= values[k];
    }
  }
  /// d(target)/d(mean strain), without the cap.
  double target_slope(double mean_strain, double coefficient) const {
    if (mean_strain <= 0.0) return 0.0;
    return parameters_.m * coefficient * power(mean_strain) / mean_strain;
  }
  /// Mean strain at which eq. 7 reaches `crack_density` (>= 0).
  double mean_strain_at(double crack_density, double coefficient) const {
    return crack_density <= 0.0 ? 0.0 : std::pow(crack_density / coefficient, 1.0 / parameters_.m);
  }

  /// Phi / (undamaged P-wave modulus): <= 0 where a plane whose normal sees the strain `normal_strain` admits
  /// a discontinuity of the strain rate while damage grows. trace: eps_kk > 0.
  double bifurcation(double x, double trace, double normal_strain) const {
    const Moduli now = moduli(x), slope = moduli_derivative(x);
    const double phi =
        now.p_wave() +
        parameters_.m * x * (slope.bulk + 2.0 * slope.shear * (normal_strain - trace / 3.0) / trace);
    return phi / undamaged_.p_wave();
  }

  /// Energy that growth from x0 to x1 sets free (J/m^3) while the strain runs from e0 linearly to e1 along
  /// eq. 7, i.e. while x = x1 (eps_v / eps_v1)^m: the integral of -e : dE/dx : e / 2 dx. Never negative.
  double dissipation(double x0, double x1, const SymmetricTensor& e0, const SymmetricTensor& e1) const;

  double exponent() const { return parameters_.m; }

 private:
  VITRUM_INLINE double weight(double x) const {
    return 1.0 - 2.0 * poisson_ + poisson_ * poisson_ * x * (1.0 - x);
  }
  /// v^m; by multiplication where m is a small integer, which is several times faster than pow.
  double power(double v) const {
    if (integer_exponent_ == 0) return std::pow(v, parameters_.m);
    double result = 1.0;
    for (unsigned n = integer_exponent_; n != 0; n >>= 1, v *= v)
      if (n & 1U) result *= v;
    return result;
  }

  DamageParameters parameters_;
  Moduli undamaged_{};
  double poisson_ = 0.0;
  double coefficient_at_unit_rate_ = 0.0;
  unsigned integer_exponent_ = 0;
};

}  // namespace vitrum
