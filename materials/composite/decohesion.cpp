#include "materials/composite/decohesion.hpp"

#include "materials/composite/tolerances.hpp"
#include "materials/root.hpp"

namespace vitrum {

DecohesionLaw::Advance DecohesionLaw::advance(double lambda0, double onset_strength,
                                              const PlaneTraction& trial, double length,
                                              double duration) const {
  // With tau_i = tau_i,trial N / (N + a Q_i c_i), a = dlambda u0 / L_e and c = (1, 1/C_m^2), the flow rule
  // (eq. 16) and eq. 13 become one equation in dlambda:  sum_i c_i tau_i,trial^2 / (S + a Q_i c_i)^2 = 1, S =
  // strength (+ viscous overstress).
  if (parameters_.viscosity > 0.0 && !(duration > 0.0))
    return {lambda0, 0.0, 0.0, false};  // a jump leaves no time to creep
  const double u0 = opening(onset_strength), driving_normal = driving(trial.normal);
  const double n2 = driving_normal * driving_normal;
  const double t2 = shear_weight_ * trial.tangential * trial.tangential;
  const double stiffness_n = trial.normal_stiffness * u0 / length;
  const double stiffness_t = trial.tangential_stiffness * shear_weight_ * u0 / length;
  const double overstress =
      parameters_.viscosity > 0.0 ? onset_strength * parameters_.viscosity / duration : 0.0;
  const auto carried = [&](double step) {
    return strength(lambda0 + step, onset_strength) + overstress * step;
  };
  // > 0 where the trial exceeds what the plane carries after `step`.
  const auto imbalance = [&](double step) {
    const double s = carried(step), dn = s + stiffness_n * step, dt = s + stiffness_t * step;
    return (n2 > 0.0 ? n2 / (dn * dn) : 0.0) + (t2 > 0.0 ? t2 / (dt * dt) : 0.0) - 1.0;
  };
  const auto in_equilibrium = [&](double step) { return imbalance(step) <= 0.0; };

  // The smallest equilibrium: grow the bracket from an estimate of the step. Shortly before a snap-back the
  // equilibrium is a narrow dip of the imbalance, which the bracket may step over.
  const double left = 1.0 - lambda0;
  const double excess = std::sqrt(n2 + t2) - carried(0.0);
  double high = std::min(left, std::max(excess / std::max(stiffness_n + stiffness_t, 1.0), 1e-14));
  double behind = 0.0, low = 0.0;
  double at_behind = imbalance(0.0), at_low = at_behind;
  for (;;) {
    const double at_high = imbalance(high);
    if (!(at_high > 0.0)) break;
    if (at_low <= at_behind && at_low < at_high) {
      const double least = least_argument(behind, high, imbalance);
      if (in_equilibrium(least)) {
        low = behind, high = least;
        break;
      }
    }
    if (high >= left) return {1.0, 0.0, 0.0, true};
    behind = low, at_behind = at_low;
    low = high, at_low = at_high;
    high = std::min(left, std::min(2.0 * high, high + 0.02));
  }
  const double step = first_reached(low, high, in_equilibrium);
  if (left - step < tolerance::rounding) return {1.0, 0.0, 0.0, true};  // what strength is left is rounding

  // m = u0 (tau_n, tau_t / C_m^2) / N at the end of the step (eq. 16).
  const double s = carried(step);
  const double tau_n = driving_normal * s / (s + stiffness_n * step);
  const double tau_t = trial.tangential * s / (s + stiffness_t * step);
  const double N = std::sqrt(tau_n * tau_n + shear_weight_ * tau_t * tau_t);
  if (!(N > 0.0)) return {1.0, 0.0, 0.0, true};
  return {lambda0 + step, step * u0 * tau_n / N, step * u0 * shear_weight_ * tau_t / N, false};
}

double DecohesionLaw::hardening_denominator(double lambda, double onset_strength,
                                            const PlaneTraction& traction, double length) const {
  const double N = effective_traction(traction.normal, traction.tangential);
  const double mn = N > 0.0 ? driving(traction.normal) / N : 1.0;
  const double mt = N > 0.0 ? shear_weight_ * traction.tangential / N : 0.0;
  const double q = parameters_.q;
  const double softening = q == 1.0 ? 1.0 : q * std::pow(lambda, q - 1.0);
  return (mn * mn * traction.normal_stiffness + mt * mt * traction.tangential_stiffness) / length -
         onset_strength * softening / opening(onset_strength);
}

}  // namespace vitrum
