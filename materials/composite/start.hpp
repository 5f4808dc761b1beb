#pragma once
#include "materials/composite/closed_form.hpp"

// What a given state asks for at the instant at which it is given.

namespace vitrum {

template <bool D, Yielding Y, bool C>
void CompositeClosedForm<D, Y, C>::judge([[maybe_unused]] CompositeState& s,
                                         [[maybe_unused]] PointReport& report) const {
  if constexpr (dissipates) {
    if constexpr (D)
      if (!is_localised(s)) damage_at_once(s, report);
    CompositeMode mode;
    mode.tension = trace(s.elastic_strain) > 0.0;
    if constexpr (C)
      if (is_localised(s)) mode = localised_mode(s);
    fall_to_admissible_stress(mode, s, 0.0, report);
    if constexpr (C)
      if (is_localised(s) && is_overloaded(localised_mode(s), s))
        release_plane_at_once(s, Jump::snap_back, false, 0.0, report);
  }
}

/// The crack density of eq. 7 at the rate known so far, at constant strain; no more than admits a
/// discontinuity, which then localises.
template <bool D, Yielding Y, bool C>
void CompositeClosedForm<D, Y, C>::damage_at_once(CompositeState& s, PointReport& report) const {
  const double coefficient = damage_.coefficient(damage_.effective_rate(s.max_rate));
  double density = damage_.target(trace(s.elastic_strain) / 3.0, coefficient);
  if (!(density > s.crack_density * (1.0 + tolerance::written))) return;
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
  if (s.crack_density == 0.0) report.record(EventKind::damage, 0.0, stress(s));
  const double stored = stored_energy(s);
  s.crack_density = density;
  report.dissipation.damage += stored - stored_energy(s);
  if constexpr (C) {
    if (!localises) return;
    start_decohesion(true, true, s);
    report.record(EventKind::localisation, 0.0, stress(s));
  }
}

}  // namespace vitrum
