#pragma once
#include "materials/composite/models.hpp"

// The yield surface: its function and normal, the return to it, and falls onto it at one instant.

namespace vitrum {

/// Whether a yield surface exists on this side of zero mean strain (Drucker-Prager: under pressure only), and
/// for a point that is as far as this one.
template <bool D, Yielding Y, bool C>
bool CompositeModels<D, Y, C>::surface_acts(bool tension, const CompositeState& s) const {
  if constexpr (has_yield && C)
    if (is_localised(s) && !decohesion_.flows(is_separated(s))) return false;
  return Y == Yielding::von_mises || (Y == Yielding::drucker_prager && !tension);
}

/// Stress measure minus strength, Pa; > 0 outside the yield surface.
template <bool D, Yielding Y, bool C>
double CompositeModels<D, Y, C>::yield_function(const CompositeState& s, const Moduli& moduli) const {
  if constexpr (Y == Yielding::von_mises)
    return von_mises_.yield_function(s.elastic_strain, moduli, s.plastic_strain);
  else if constexpr (Y == Yielding::drucker_prager)
    return pressure_surface(s).yield_function(s.elastic_strain, moduli);
  else
    return -1.0;
}

/// d f / d e of the yield function, Pa.
template <bool D, Yielding Y, bool C>
SymmetricTensor CompositeModels<D, Y, C>::yield_gradient(const CompositeState& s, const Moduli& m) const {
  const SymmetricTensor d = deviator(s.elastic_strain);
  const double size = norm(d);
  const SymmetricTensor n = size > 0.0 ? (1.0 / size) * d : SymmetricTensor{};
  if constexpr (Y == Yielding::drucker_prager)
    return (2.0 * m.shear * std::sqrt(1.5)) * n + (parameters_.drucker_prager->beta * m.bulk) * identity();
  return (2.0 * m.shear) * n;
}

/// d eps_p / d I.
template <bool D, Yielding Y, bool C>
SymmetricTensor CompositeModels<D, Y, C>::flow_direction(const CompositeState& s) const {
  const SymmetricTensor d = deviator(s.elastic_strain);
  const double size = norm(d);
  const SymmetricTensor n = size > 0.0 ? (1.0 / size) * d : SymmetricTensor{};
  if constexpr (Y == Yielding::drucker_prager) {
    const double psi = pressure_surface(s).dilatancy(), unit = std::sqrt(1.5 + psi * psi / 3.0);
    return (std::sqrt(1.5) / unit) * n + (psi / (3.0 * unit)) * identity();
  }
  return n;
}

/// Returns to the yield surface; gives the energy dissipated, J/m^3.
template <bool D, Yielding Y, bool C>
double CompositeModels<D, Y, C>::flow(CompositeState& s, const Moduli& moduli,
                                      [[maybe_unused]] double violated_before) const {
  if constexpr (Y == Yielding::von_mises) {
    const SymmetricTensor d = deviator(s.elastic_strain);
    const double trial = 2.0 * moduli.shear * norm(d);
    if (trial <= von_mises_.radius(s.plastic_strain)) return 0.0;
    const PlasticReturn result = von_mises_.flow(trial, moduli.shear, s.plastic_strain);
    const double mean = trace(s.elastic_strain) / 3.0;
    s.elastic_strain = mean * identity() + (1.0 - 2.0 * moduli.shear * result.flow / trial) * d;
    return result.dissipation;
  } else if constexpr (Y == Yielding::drucker_prager) {
    return pressure_surface(s).flow(s.elastic_strain, moduli, violated_before, s.plastic_strain).dissipation;
  } else {
    return 0.0;
  }
}

/// Shear that only tension allowed, or an initial stress, falls onto the yield surface at constant strain;
/// whether there was any.
template <bool D, Yielding Y, bool C>
bool CompositeModels<D, Y, C>::fall_onto_surface(const CompositeMode& mode, CompositeState& s,
                                                 Dissipation& dissipation) const {
  if (!surface_acts(mode.tension, s)) return false;
  const Moduli m = secant(mode.tension, s);
  const double excess = yield_function(s, m);
  if (!(excess > tolerance::on_surface * m.shear * norm(deviator(s.elastic_strain)))) return false;
  if (C && mode.separated() && !is_rubble(s)) {
    flow_behind_crack(s, mode.tension, excess, dissipation);
    return true;
  }
  const double stored = m.energy(s.elastic_strain);
  flow(s, m, excess);
  dissipation.plastic += std::max(0.0, stored - m.energy(s.elastic_strain));
  return true;
}

/// Stress outside the yield surface falls onto it at constant strain. That may load a plane with more than it
/// bears, which then opens at once, and leaves stress outside again. is_yield: the first fall is an event.
template <bool D, Yielding Y, bool C>
void CompositeModels<D, Y, C>::fall_to_admissible_stress(CompositeMode& mode, CompositeState& s,
                                                         double fraction, PointReport& report,
                                                         bool is_yield) const {
  if constexpr (has_yield) {
    constexpr int most_turns = 64;
    for (int turn = 0; turn < most_turns && fall_onto_surface(mode, s, report.dissipation); ++turn) {
      if (turn == 0 && is_yield) report.record(EventKind::yield, fraction, stress(s));
      if constexpr (C) {
        if (!is_overloaded(mode, s)) break;
        snap_back(s, secant(mode.tension, s), report.dissipation);
        if (is_separated(s)) enter_separated(mode, s, fraction, report);
      }
    }
  }
}

/// Whether the strength falls faster than elastic unloading at constant strain.
template <bool D, Yielding Y, bool C>
bool CompositeModels<D, Y, C>::softens_past_equilibrium(const CompositeMode& mode,
                                                        const CompositeState& s) const {
  const Moduli m = secant(mode.tension, s);
  SymmetricTensor given = flow_direction(s);
  if constexpr (C) {
    double gap = 0.0, slip = 0.0;
    if (mode.separated()) given = strain_left_by_faces(mode, s, m, given, gap, slip);
  }
  return contract(yield_gradient(s, m), given) + VonMisesLaw::factor * mode.hardening_modulus <= 0.0;
}

}  // namespace vitrum
