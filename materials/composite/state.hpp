#pragma once
#include "materials/batch.hpp"

namespace vitrum {

/// One point of the composite, with room for the variables of all its models (those of absent models stay at
/// their initial value).
struct CompositeState : LawState {
  double crack_density = 0.0;      ///< rho_d, eq. 7
  double max_rate = 0.0;           ///< rate of eps_v that enters eq. 7 (damage.rate), 1/s
  double plastic_strain = 0.0;     ///< I, eq. 23
  double decohesion = 0.0;         ///< lambda, eq. 13; 1: separated
  double opening_n = 0.0;          ///< normal decohesion, m, eq. 14
  double opening_t = 0.0;          ///< tangential decohesion, m, eq. 14 (t is n turned by +90 degrees)
  PlaneVector normal{};            ///< unit normal of the decohesion plane; both components 0: the hoop plane
  double effective_length = 0.0;   ///< L_e, m, eq. 12; 0: not localised
  double cohesive_strength = 0.0;  ///< tau_np, Pa, eq. 18
  double mean_rate = 0.0;          ///< rate of eps_v averaged over a time, 1/s
  double strength_factor = 1.0;    ///< by which eps_v is divided before it enters eq. 7
};

constexpr bool is_localised(const CompositeState& s) {
  return s.effective_length > 0.0;
}
constexpr bool is_separated(const CompositeState& s) {
  return s.decohesion >= 1.0;
}

}  // namespace vitrum
