#pragma once
#include "materials/composite/models.hpp"

// Damage that a state asks for at one instant: that is given, or that meets a lower rate.

namespace vitrum {

/// The crack density of eq. 7 at the rate known so far, at constant strain; no more than admits a
/// discontinuity, which then localises. True where it has.
template <bool D, Yielding Y, bool C>
bool CompositeModels<D, Y, C>::damage_at_once(CompositeState& s, double fraction, PointReport& report) const {
  const double coefficient = damage_.coefficient(damage_.effective_rate(s.max_rate));
  double density = damage_.target(damaging_strain(s), coefficient);
  if (!(density > s.crack_density * (1.0 + tolerance::written))) return false;
  bool localises = false;
  if constexpr (C) {
    // Phi changes sign once as the crack density grows.
    const auto is_critical_at = [&](double value) {
      CompositeState tried = s;
      tried.crack_density = value;
      return damage_localisation(tried) <= 0.0;
    };
    localises = is_critical_at(density);
    if (localises) density = first_reached(s.crack_density, density, is_critical_at);
  }
  if (s.crack_density == 0.0) report.record(EventKind::damage, fraction, stress(s));
  const double stored = stored_energy(s);
  s.crack_density = density;
  report.dissipation.damage += stored - stored_energy(s);
  if constexpr (C) {
    if (localises) {
      start_decohesion(true, true, s, report.dissipation);
      report.record(EventKind::localisation, fraction, stress(s));
    }
  }
  return localises;
}

}  // namespace vitrum
