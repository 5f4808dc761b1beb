#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>

#include "materials/elasticity.hpp"
#include "materials/scatter.hpp"
#include "schema/fields.hpp"

namespace vitrum {

/// Which rate of eps_v enters eq. 7.
enum class DamageRate : unsigned char {
  running_maximum,   ///< the largest so far while eps_v grew under tension
  current,           ///< that of the increment
  maximum_any_sign,  ///< the largest size so far, of growth or fall under tension or pressure
  averaged,          ///< the largest so far of the average over a time
  fixed
};

/// Scene table [material.NAME.damage]: rate-dependent tensile damage, eqs. 4-9.
struct DamageParameters {
  double toughness = 0.0;   ///< K_IC, Pa sqrt(m)
  double k = 0.0;           ///< 1/m^3
  double m = 0.0;           ///< exponent of eq. 7
  double rate_floor = 1.0;  ///< 1/s, least rate that enters eq. 7
  double fixed_rate = 0.0;  ///< 1/s; > 0: this rate enters eq. 7 whatever the history
  DamageRate history = DamageRate::running_maximum;  ///< of the first three; where none of the times is set
  double averaging_time = 0.0;                       ///< s; > 0: the rate is averaged over it
  bool volumetric = false;                           ///< eps_v is tr(e) instead of the mean strain tr(e)/3
  bool pressure_wave = false;                        ///< c is the speed of pressure waves instead of a bar's
  std::optional<StrengthScatter> scatter = {};       ///< of the strength; none: every point is the same

  DamageRate rate() const {
    return fixed_rate > 0.0 ? DamageRate::fixed : averaging_time > 0.0 ? DamageRate::averaged : history;
  }
  static schema::Fields<DamageParameters> rows();
};

/// Crack density at which the material has lost all tensile stiffness (x = 1).
inline constexpr double crack_density_limit = 9.0 / 16.0;

/// The law of eqs. 4-8 for one material, in terms of x = 16 rho_d / 9 in [0, 1]. Pure functions.
class DamageLaw {
 public:
  DamageLaw() = default;
  DamageLaw(const DamageParameters& parameters, const ElasticParameters& elastic);

  /// Damaged moduli, eqs. 5, 6, 8.
  VITRUM_INLINE Moduli moduli(double x) const {
    const auto [bulk, shear] = moduli_of(x);
    return {bulk, shear};
  }

  /// lambda / (2 G) of the damaged moduli, nu_bar / (1 - 2 nu_bar).
  double lateral_ratio(double x) const {
    const double nu_bar = poisson_ * (1.0 - x);
    return nu_bar / (1.0 - 2.0 * nu_bar);
  }

  /// d(moduli)/dx.
  Moduli moduli_derivative(double x) const {
    const auto [bulk, shear] = slopes_of(x);
    return {bulk, shear};
  }

  /// D = 1 - K_bar/K, eq. 8.
  double damage(double x) const { return 1.0 - moduli(x).bulk / undamaged_.bulk; }

  /// eps_v of a trace, and the trace at it.
  VITRUM_INLINE double strain_of(double trace) const { return trace / trace_per_strain_; }
  VITRUM_INLINE double trace_of(double strain) const { return trace_per_strain_ * strain; }
  double rate_of(double trace_change, double duration) const {
    return trace_change / (trace_per_strain_ * duration);
  }

  DamageRate rate() const { return parameters_.rate(); }
  const std::optional<StrengthScatter>& scatter() const { return parameters_.scatter; }
  bool averages_rate() const { return parameters_.rate() == DamageRate::averaged; }
  /// Takes up the rates of an increment that begins, whatever its sign. max_rate: what enters eq. 7;
  /// mean_rate: the average, R' = (eps_v' - R) / averaging_time, of which an increment sees the end.
  void begin(double trace_change, double duration, double& max_rate, double& mean_rate) const {
    if (!(duration > 0.0)) return;
    const double rate = rate_of(trace_change, duration);
    if (parameters_.rate() == DamageRate::maximum_any_sign)
      max_rate = std::max(max_rate, std::abs(rate));
    else if (averages_rate())
      mean_rate -= (rate - mean_rate) * std::expm1(-duration / parameters_.averaging_time);
  }
  /// The same, where eps_v grows under tension.
  void grow(double trace_change, double duration, double& max_rate, double mean_rate) const {
    if (!(trace_change > 0.0 && duration > 0.0)) return;
    if (parameters_.rate() == DamageRate::current)
      max_rate = rate_of(trace_change, duration);
    else
      max_rate = std::max(max_rate, averages_rate() ? mean_rate : rate_of(trace_change, duration));
  }
  /// The rate that enters eq. 7 when the rate of the history is `max_rate`, 1/s.
  VITRUM_INLINE double effective_rate(double max_rate) const {
    return parameters_.fixed_rate > 0.0 ? parameters_.fixed_rate : std::max(max_rate, parameters_.rate_floor);
  }
  /// C(R) of rho_d = C eps_v^m (eq. 7). rate: 1/s, > 0.
  VITRUM_INLINE double coefficient(double rate) const { return coefficient_at_unit_rate_ / (rate * rate); }

  /// Crack density of eq. 7 at eps_v, capped at 9/16; 0 where eps_v <= 0.
  double target(double strain, double coefficient) const {
    if (strain <= 0.0) return 0.0;
    return std::min(coefficient * power(strain), crack_density_limit);
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
  /// d(target)/d(eps_v), without the cap.
  double target_slope(double strain, double coefficient) const {
    if (strain <= 0.0) return 0.0;
    return parameters_.m * coefficient * power(strain) / strain;
  }
  /// eps_v at which eq. 7 reaches `crack_density` (>= 0).
  double strain_at(double crack_density, double coefficient) const {
    return crack_density <= 0.0 ? 0.0 : std::pow(crack_density / coefficient, 1.0 / parameters_.m);
  }

  /// Phi / (undamaged P-wave modulus): <= 0 where a plane whose normal sees the strain `normal_strain` admits
  /// a discontinuity of the strain rate while damage grows. trace: eps_kk > 0. Of intervals: a bound.
  template <class Number>
  Number bifurcation(const Number& x, const Number& trace, const Number& normal_strain) const {
    const auto now = moduli_of(x), slope = slopes_of(x);
    const Number phi =
        now.bulk + 4.0 / 3.0 * now.shear +
        parameters_.m * x * (slope.bulk + 2.0 * slope.shear * (normal_strain - trace / 3.0) / trace);
    return phi / undamaged_.p_wave();
  }

  /// Energy that growth from x0 to x1 sets free (J/m^3) while the strain runs from e0 linearly to e1 along
  /// eq. 7, i.e. while x = x1 (eps_v / eps_v1)^m: the integral of -e : dE/dx : e / 2 dx. Never negative.
  double dissipation(double x0, double x1, const SymmetricTensor& e0, const SymmetricTensor& e1) const;

  double exponent() const { return parameters_.m; }

 private:
  template <class Number>
  struct BulkAndShear {
    Number bulk, shear;
  };
  template <class Number>
  VITRUM_INLINE Number weight(const Number& x) const {
    return 1.0 - 2.0 * poisson_ + poisson_ * poisson_ * x * (1.0 - x);
  }
  /// Moduli of a number or an interval; written without the cancellation of 1 - D.
  template <class Number>
  VITRUM_INLINE BulkAndShear<Number> moduli_of(const Number& x) const {
    const Number nu_bar = poisson_ * (1.0 - x);
    const Number common = undamaged_.bulk * (1.0 - x) * weight(x);
    return {common / (1.0 - 2.0 * nu_bar), 1.5 * common / (1.0 + nu_bar)};
  }
  /// d(moduli)/dx of a number or an interval.
  template <class Number>
  BulkAndShear<Number> slopes_of(const Number& x) const {
    const double nu = poisson_, K = undamaged_.bulk;
    const Number nu_bar = nu * (1.0 - x), w = weight(x);
    const Number slope = -w + (1.0 - x) * nu * nu * (1.0 - 2.0 * x);
    const Number a = 1.0 - 2.0 * nu_bar, b = 1.0 + nu_bar;
    return {K * (slope / a - 2.0 * nu * (1.0 - x) * w / (a * a)),
            1.5 * K * (slope / b + nu * (1.0 - x) * w / (b * b))};
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
  double trace_per_strain_ = 3.0;  ///< 3 where eps_v is the mean strain, 1 where it is the trace
  unsigned integer_exponent_ = 0;
};

}  // namespace vitrum
