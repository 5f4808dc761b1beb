#include "materials/composite/drucker_prager.hpp"

#include <algorithm>

namespace vitrum {

PlasticReturn DruckerPragerLaw::flow(SymmetricTensor& elastic_strain, const Moduli& moduli,
                                     double violated_before, double& plastic_strain) const {
  const double f = yield_function(elastic_strain, moduli);
  if (!(f > 0.0)) return {};
  const double K = moduli.bulk, G = moduli.shear;
  double multiplier = f / (3.0 * G + K * parameters_.beta * dilatancy_);
  const SymmetricTensor d = deviator(elastic_strain);
  const double trial_q = 2.0 * G * std::sqrt(1.5 * contract(d, d));
  double q = trial_q - 3.0 * G * multiplier;
  const double trial_trace = trace(elastic_strain);
  double end_trace = trial_trace - dilatancy_ * multiplier;
  if (!(q > 0.0) &&
      dilatancy_ > 0.0) {  // beyond the apex, which only a trial far into tension under dilatant flow sees
    q = 0.0;
    end_trace = parameters_.yield / (parameters_.beta * K);
    multiplier = (trial_trace - end_trace) / dilatancy_;
  }
  const double scale = trial_q > 0.0 ? q / trial_q : 0.0;
  const double mean = end_trace / 3.0;
  elastic_strain = {scale * d.rr + mean, scale * d.zz + mean, scale * d.tt + mean, scale * d.rz};
  plastic_strain += multiplier * std::sqrt(1.5 + dilatancy_ * dilatancy_ / 3.0);

  // On the surface q - beta_psi P dissipates per unit of the multiplier; a violation at the start releases
  // along the chord.
  const double pressure = -K * end_trace, trial_pressure = -K * trial_trace;
  const double on_surface = q - dilatancy_ * pressure;
  const double sudden_share = std::clamp(violated_before / f, 0.0, 1.0);
  const double chord = 0.5 * (on_surface + trial_q - dilatancy_ * trial_pressure);
  return {multiplier, multiplier * std::max(0.0, sudden_share * chord + (1.0 - sudden_share) * on_surface)};
}

}  // namespace vitrum
