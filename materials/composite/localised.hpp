#pragma once
#include "materials/composite/closed_form.hpp"

// The rest of an increment after localisation.

namespace vitrum {

/// The rest of an increment after localisation (`done`: fraction of the increment before). Damage is frozen;
/// the plane softens, separates, opens and closes; the material behind it may still flow.
template <bool D, Yielding Y, bool C>
void CompositeClosedForm<D, Y, C>::advance_localised(CompositeState& s, const SymmetricTensor& strain,
                                                     double duration, double done,
                                                     PointReport& report) const {
  double fraction = 0.0;
  const auto at = [done](double f) { return done + f * (1.0 - done); };
  double outside = outside_under_pressure(s);
  // Each pass takes the increment to its next event: onset of softening, a substep of it, a jump of the
  // plane, a change of side.
  for (int pass = 0; pass < 256 && fraction < 1.0; ++pass) {
    const double left = 1.0 - fraction;
    if (is_rubble(s)) {
      advance_rubble(s, left * strain, at(fraction), report);
      fraction = 1.0;
    } else if (is_separated(s)) {
      const double closed_at = advance_separated(s, left * strain, report.dissipation);
      if (closed_at >= 0.0) report.record(EventKind::closure, at(fraction + left * closed_at), stress(s));
      fraction = 1.0;
    } else {
      Jump jump = Jump::none;
      const double taken =
          advance_cohesive(s, left * strain, left * duration, pass >= 128, jump, report.dissipation);
      fraction = taken >= 1.0 ? 1.0 : fraction + left * taken;
      if (jump == Jump::none) continue;
      // What the strain has done so far flows first: all that the jump itself leaves outside the yield
      // surface falls onto it at this instant.
      flow_behind_crack(s, outside, at(fraction), report);
      release_plane_at_once(s, jump, false, at(fraction), report);
      outside = outside_under_pressure(s);
    }
  }
  if (fraction < 1.0) s.elastic_strain += (1.0 - fraction) * strain;
  const double flowed = s.plastic_strain;
  flow_behind_crack(s, outside, at(1.0), report);
  // Flow that loads a softening plane with more than it bears opens it at once, and so on, until the stress
  // is on both surfaces.
  if (s.plastic_strain > flowed && is_overloaded(localised_mode(s), s))
    release_plane_at_once(s, Jump::snap_back, true, at(1.0), report);
}

/// How far outside the yield surface the stress lies, Pa. Tension may have carried the point beyond the
/// strength that it has under pressure.
template <bool D, Yielding Y, bool C>
double CompositeClosedForm<D, Y, C>::outside_under_pressure(const CompositeState& s) const {
  return has_yield && surface_acts(false, s) ? std::max(0.0, yield_function(s, secant(false, s))) : 0.0;
}

/// The jump of a plane that lost its equilibrium, and the falls that follow from it at the same instant.
/// flows: they go on with a flow that is known.
template <bool D, Yielding Y, bool C>
void CompositeClosedForm<D, Y, C>::release_plane_at_once(CompositeState& s, Jump jump, bool flows,
                                                         double fraction, PointReport& report) const {
  const Moduli moduli = secant(trace(s.elastic_strain) > 0.0, s);
  jump == Jump::snap_back ? snap_back(s, moduli, report.dissipation)
                          : separate(s, moduli, report.dissipation);
  CompositeMode mode = localised_mode(s);
  if (is_separated(s)) report.record(EventKind::separation, fraction, stress(s));
  fall_to_admissible_stress(mode, s, fraction, report, !flows);
}

/// One pass of the softening plane (0 <= lambda < 1); returns the fraction of `strain` it consumed. `jump`:
/// what the plane does at the end of it. at_once: takes what is left in one implicit step with the moduli of
/// the start (for the rare path that chatters about zero mean strain).
template <bool D, Yielding Y, bool C>
double CompositeClosedForm<D, Y, C>::advance_cohesive(CompositeState& s, const SymmetricTensor& strain,
                                                      double duration, bool at_once, Jump& jump,
                                                      Dissipation& dissipation) const {
  const double start_trace = trace(s.elastic_strain), change = trace(strain);
  // The moduli are those of one side of zero mean strain: the pass ends where the side changes.
  bool tension = start_trace > 0.0 || (start_trace == 0.0 && change > 0.0);
  double end = 1.0;
  const bool two_sides = s.crack_density > 0.0 && !at_once;
  if (two_sides && (start_trace + change > 0.0) != tension && change != 0.0) {
    end = std::clamp(-start_trace / change, 0.0, 1.0);
    if (end < tolerance::rounding) tension = !tension, end = 1.0;
  }
  const Moduli moduli = secant(tension, s);
  const DecohesionPlane plane{s.normal};
  const auto traction_at = [&](double f) { return traction(plane, s.elastic_strain + f * strain, moduli); };
  const auto effective = [&](const PlaneTraction& t) {
    return decohesion_.effective_traction(t.normal, t.tangential);
  };
  const double strength = decohesion_.strength(s.decohesion, s.cohesive_strength);
  const double rounding = tolerance::traction_rounding * (s.cohesive_strength + effective(traction_at(0.0)));

  // Below the strength: elastic with the opening frozen (the norm of a straight path is convex, so the end
  // tells).
  if (effective(traction_at(end)) <= strength + rounding) {
    s.elastic_strain += end * strain;
    return end;
  }
  // (An equilibrium that was solved for may fall short of the strength by rounding.)
  if (effective(traction_at(0.0)) < strength - tolerance::equilibrium * s.cohesive_strength - rounding) {
    const double onset =
        first_reached(0.0, end, [&](double f) { return effective(traction_at(f)) >= strength; });
    s.elastic_strain += onset * strain;
    return onset;
  }

  // Softening. The implicit step is exact in a pure mode; where the mode may turn, lambda moves by at most
  // 0.1 at a time.
  const PlaneTraction start = traction_at(0.0);
  const double denominator =
      decohesion_.hardening_denominator(s.decohesion, s.cohesive_strength, start, s.effective_length);
  const bool viscous = decohesion_.viscosity() > 0.0;
  const double wanted = effective(traction_at(end)) - strength;
  const double estimate = wanted / (decohesion_.opening(s.cohesive_strength) * std::max(denominator, 1e-300));
  const double step =
      denominator > 0.0 && !at_once ? end / std::clamp(std::ceil(estimate / 0.1), 1.0, 64.0) : end;
  const auto advanced = [&](double f) {
    return decohesion_.advance(s.decohesion, s.cohesive_strength, traction_at(f), s.effective_length,
                               f * duration);
  };
  const auto soften = [&](double f, const DecohesionLaw::Advance& next) {
    const double growth = next.decohesion - s.decohesion;
    double surface = decohesion_.surface_energy(s.decohesion, next.decohesion, s.cohesive_strength);
    if (viscous && f * duration > 0.0)  // the overstress tau_np eta lambda' works on the opening as well
      surface += decohesion_.opening(s.cohesive_strength) * s.cohesive_strength * decohesion_.viscosity() *
                 growth * growth / (f * duration);
    dissipation.fracture += surface / s.effective_length;
    s.elastic_strain +=
        f * strain - plane.jump_strain(next.normal_opening, next.tangential_opening, s.effective_length);
    s.decohesion = next.decohesion;
    s.opening_n += next.normal_opening;
    s.opening_t += next.tangential_opening;
  };

  if (denominator <= 0.0 && !viscous) {
    jump = Jump::snap_back;
    return 0.0;
  }
  const DecohesionLaw::Advance next = advanced(step);
  if (!next.separates) {
    soften(step, next);
    return step;
  }
  // The last equilibrium before separation: lambda near 1, or less where the softening turns into a snap-back
  // on its way.
  const double separated_at = first_reached(0.0, step, [&](double f) { return advanced(f).separates; });
  const double last = separated_at - tolerance::rounding * step;
  const DecohesionLaw::Advance before = advanced(std::max(last, 0.0));
  if (last > 0.0 && !before.separates) {
    soften(last, before);
    s.elastic_strain += (separated_at - last) * strain;
  } else {
    s.elastic_strain += separated_at * strain;
  }
  jump = Jump::separation;
  return separated_at;
}

/// A separated plane over `strain`; returns the fraction at which an open crack closed, or -1.
template <bool D, Yielding Y, bool C>
double CompositeClosedForm<D, Y, C>::advance_separated(CompositeState& s, const SymmetricTensor& strain,
                                                       Dissipation& dissipation) const {
  const CompositeState before = s;
  const double gap = s.opening_n;
  const DecohesionPlane plane{s.normal};
  const PlaneTraction change = traction(plane, strain, secant_moduli(s));
  s.elastic_strain += strain;
  free_faces(s);
  if (decohesion_.is_dust()) return -1.0;
  const bool closes = gap > 0.0 && !(s.opening_n > 0.0), rubs = decohesion_.friction() > 0.0;
  double closed_at = -1.0;
  if (closes && !decohesion_.has_faces()) {
    closed_at = std::clamp(-gap / (trace(strain) * s.effective_length), 0.0, 1.0);
  } else if (closes) {
    // Between traction-free faces the gap shrinks linearly along the path until they meet.
    const double closing = -change.normal * s.effective_length;
    closed_at = closing > 0.0 ? std::clamp(gap * change.normal_stiffness / closing, 0.0, 1.0) : 1.0;
  }
  if (!rubs || (gap > 0.0 && !closes)) return closed_at;
  // Faces slide freely until they meet, and rub until they part.
  s = before;
  double from = 0.0, to = 1.0;
  if (closes) {
    from = closed_at;
    s.elastic_strain += from * strain;
    free_faces(s);
    s.opening_n = 0.0;
  } else {
    const double pressing = -traction(plane, s.elastic_strain, secant_moduli(s)).normal;
    if (change.normal > pressing) to = std::max(0.0, pressing / change.normal);
  }
  rub_faces(s, (to - from) * strain, dissipation);
  if (to < 1.0) {
    s.elastic_strain += (1.0 - to) * strain;
    free_faces(s);
  }
  return closed_at;
}

/// Closed faces over `strain`, on a straight path of the traction: they stick until shear reaches Coulomb's
/// cone, and then slide along it. Their work is booked as plastic.
template <bool D, Yielding Y, bool C>
void CompositeClosedForm<D, Y, C>::rub_faces(CompositeState& s, const SymmetricTensor& strain,
                                             Dissipation& dissipation) const {
  const DecohesionPlane plane{s.normal};
  const PlaneTraction start = traction(plane, s.elastic_strain, secant_moduli(s));
  const double opening = s.opening_t, friction = decohesion_.friction();
  s.elastic_strain += strain;
  free_faces(s);
  const double slip = s.opening_t - opening;
  if (slip == 0.0) return;
  const PlaneTraction end = traction(plane, s.elastic_strain, secant_moduli(s));
  const double side = slip > 0.0 ? 1.0 : -1.0;
  const double borne = -friction * std::min(start.normal, 0.0), borne_at_end = side * end.tangential;
  const double missing = borne - side * start.tangential;  // to the cone, at the start
  const double beyond = side * slip * end.tangential_stiffness / s.effective_length;
  const double onset = std::max(missing, 0.0) / (std::max(missing, 0.0) + beyond);
  const double mean = 0.5 * (borne + onset * (borne_at_end - borne) + borne_at_end);
  dissipation.plastic += std::max(mean, 0.0) * side * slip / s.effective_length;
}

/// Plastic flow of a localised point, and what it does to its faces, told at `fraction` of the increment.
template <bool D, Yielding Y, bool C>
void CompositeClosedForm<D, Y, C>::flow_behind_crack(CompositeState& s, double outside_before,
                                                     double fraction, PointReport& report) const {
  if constexpr (has_yield) {
    const double flowed = s.plastic_strain, gap = s.opening_n;
    flow_behind_crack(s, trace(s.elastic_strain) > 0.0, outside_before, report.dissipation);
    if (flowed == 0.0 && s.plastic_strain > 0.0) report.record(EventKind::yield, fraction, stress(s));
    if (is_separated(s) && gap > 0.0 && s.opening_n == 0.0)
      report.record(EventKind::closure, fraction, stress(s));
  }
}

}  // namespace vitrum
