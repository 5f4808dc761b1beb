#pragma once
#include "materials/composite/models.hpp"

// Plastic flow of a localised point, whose faces answer it.

namespace vitrum {

/// Plastic flow of a localised point: behind a separated plane the faces stay free of traction while the
/// material flows. outside_before: what of the violation (Pa) falls onto the surface at once and loses all
/// its energy; the rest flows along it. tension: the side of a mean strain that rounding
/// alone tells from zero.
template <bool D, Yielding Y, bool C>
void CompositeModels<D, Y, C>::flow_behind_crack(CompositeState& s, bool tension, double outside_before,
                                                 Dissipation& dissipation) const {
  const auto excess = [&](const CompositeState& c) {  // > 0 outside the yield surface, Pa
    const double mean = trace(c.elastic_strain);
    const bool side = std::abs(mean) <= tolerance::rounding * norm(c.elastic_strain) ? tension : mean > 0.0;
    return surface_acts(side, c) ? yield_function(c, secant(side, c)) : 0.0;
  };
  const double admitted = tolerance::on_surface * elastic_.shear * norm(deviator(s.elastic_strain));
  const double violated = excess(s);
  if (!(violated > admitted)) return;
  if (!is_separated(s) || is_rubble(s)) {
    dissipation.plastic += flow(s, secant(tension, s), outside_before);
    return;
  }

  // Flow and traction-free faces are met in turn. What a unit of flow took off the excess the last time, the
  // faces' answer included, tells how much flow the next turn needs, forth or back.
  const double stored = stored_energy(s), flowed_before = s.plastic_strain;
  double value = violated, resistance = 1.0;  // relative to that without faces
  SymmetricTensor flowed{};                   // plastic strain
  for (int turn = 0; turn < 50 && std::abs(value) > admitted; ++turn) {
    const double wanted = value / resistance;
    flowed += flow_along_deviator(s, wanted);
    free_faces(s);
    const double next = excess(s);
    resistance = std::clamp((value - next) / wanted, 0.25, 4.0);
    value = next;
  }
  const double lost = std::max(0.0, stored - stored_energy(s)),
               sudden_share =
                   fell_behind_crack(s, flowed_before) ? 1.0 : std::min(1.0, outside_before / violated);
  double along_surface = contract(secant_moduli(s).stress(s.elastic_strain), flowed);
  if constexpr (Y == Yielding::von_mises) along_surface = von_mises_.work(flowed_before, s.plastic_strain);
  dissipation.plastic += sudden_share * lost + (1.0 - sudden_share) * std::clamp(along_surface, 0.0, lost);
}

/// Whether flow from `flowed_before` softened faster than elasticity unloads behind the faces that give way,
/// and fell at constant strain.
template <bool D, Yielding Y, bool C>
bool CompositeModels<D, Y, C>::fell_behind_crack(const CompositeState& s, double flowed_before) const {
  if constexpr (Y == Yielding::von_mises) {
    const double softest = std::max(flowed_before, von_mises_.peak_strain());
    CompositeMode mode = localised_mode(s);
    mode.hardening_modulus = von_mises_.modulus(softest);
    return s.plastic_strain > softest && mode.hardening_modulus < 0.0 && softens_past_equilibrium(mode, s);
  } else {
    return false;
  }
}

/// Plastic flow that lowers the stress measure by `excess` (Pa) when no face moves and the strength stays; at
/// most half of the deviator, which is to keep its direction. Returns the plastic strain.
template <bool D, Yielding Y, bool C>
SymmetricTensor CompositeModels<D, Y, C>::flow_along_deviator(CompositeState& s, double excess) const {
  const Moduli moduli = secant(trace(s.elastic_strain) > 0.0, s);
  const SymmetricTensor direction = flow_direction(s);  // per unit of |d eps_p|
  const double resistance = contract(yield_gradient(s, moduli), direction);
  if (!(resistance > 0.0)) return {};
  const double amount = std::min(excess / resistance, 0.5 * norm(deviator(s.elastic_strain)));
  s.elastic_strain -= amount * direction;
  s.plastic_strain += amount;
  return amount * direction;
}

}  // namespace vitrum
