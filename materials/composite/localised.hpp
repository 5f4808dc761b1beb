#pragma once
#include "materials/composite/composite.hpp"

namespace vitrum {

/// The rest of an increment after localisation (`done`: fraction of the increment before). Damage is frozen;
/// the plane softens, separates, opens and closes; the material behind it may still flow.
template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::advance_localised(CompositeState& s, const SymmetricTensor& strain, double duration,
                                           double done, PointReport& report) const {
  double fraction = 0.0;
  const auto at = [done](double f) { return done + f * (1.0 - done); };
  double outside = outside_under_pressure(s);
  // Each pass takes the increment to its next event: onset of softening, a substep of it, a jump of the
  // plane, a change of side.
  for (int pass = 0; pass < 256 && fraction < 1.0; ++pass) {
    const double left = 1.0 - fraction;
    if (is_separated(s)) {
      const double closed_at = advance_separated(s, left * strain);
      if (closed_at >= 0.0) report.record(EventKind::closure, at(fraction + left * closed_at));
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
      give_way_at_once(s, jump, false, at(fraction), report);
      outside = outside_under_pressure(s);
    }
  }
  if (fraction < 1.0) s.elastic_strain += (1.0 - fraction) * strain;
  const double flowed = s.plastic_strain;
  flow_behind_crack(s, outside, at(1.0), report);
  // Flow that loads a softening plane with more than it bears opens it at once, and so on, until the stress
  // is on both surfaces.
  if (s.plastic_strain > flowed && is_overloaded(localised_mode(s), s))
    give_way_at_once(s, Jump::snap_back, true, at(1.0), report);
}

/// The mode of a localised point that is at rest.
template <bool D, Yielding Y, bool C>
EvolutionMode Composite<D, Y, C>::localised_mode(const CompositeState& s) const {
  using Plane = EvolutionMode::Plane;
  EvolutionMode mode;
  mode.tension = trace(s.elastic_strain) > 0.0;
  mode.viscous = decohesion_.viscosity() > 0.0;
  mode.plane = !is_separated(s) ? Plane::held : s.opening_n > 0.0 ? Plane::open : Plane::closed;
  return mode;
}

/// How far outside the yield surface the stress lies, Pa. Tension may have carried the point beyond the
/// strength that it has under pressure.
template <bool D, Yielding Y, bool C>
double Composite<D, Y, C>::outside_under_pressure(const CompositeState& s) const {
  return has_yield ? std::max(0.0, yield_function(s, secant(false, s.crack_density))) : 0.0;
}

/// The jump of a plane that lost its equilibrium, and the falls that follow from it at the same instant.
/// flows: they go on with a flow that is known.
template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::give_way_at_once(CompositeState& s, Jump jump, bool flows, double fraction,
                                          PointReport& report) const {
  const Moduli moduli = secant(trace(s.elastic_strain) > 0.0, s.crack_density);
  jump == Jump::snap_back ? snap_back(s, moduli, report.dissipation)
                          : separate(s, moduli, report.dissipation);
  EvolutionMode mode = localised_mode(s);
  if (is_separated(s)) report.record(EventKind::separation, fraction);
  meet_surfaces(mode, s, fraction, report, !flows);
}

/// One pass of the softening plane (0 <= lambda < 1); returns the fraction of `strain` it consumed. `jump`:
/// what the plane does at the end of it. at_once: takes what is left in one implicit step with the moduli of
/// the start (for the rare path that chatters about zero mean strain).
template <bool D, Yielding Y, bool C>
double Composite<D, Y, C>::advance_cohesive(CompositeState& s, const SymmetricTensor& strain, double duration,
                                            bool at_once, Jump& jump, Dissipation& dissipation) const {
  const double start_trace = trace(s.elastic_strain), change = trace(strain);
  // The moduli are those of one side of zero mean strain: the pass ends where the side changes.
  bool tension = start_trace > 0.0 || (start_trace == 0.0 && change > 0.0);
  double end = 1.0;
  const bool two_sides = s.crack_density > 0.0 && !at_once;
  if (two_sides && (start_trace + change > 0.0) != tension && change != 0.0) {
    end = std::clamp(-start_trace / change, 0.0, 1.0);
    if (end < 1e-12) tension = !tension, end = 1.0;
  }
  const Moduli moduli = secant(tension, s.crack_density);
  const DecohesionPlane plane{s.normal};
  const auto traction_at = [&](double f) { return traction(plane, s.elastic_strain + f * strain, moduli); };
  const auto effective = [&](const PlaneTraction& t) {
    return decohesion_.effective_traction(t.normal, t.tangential);
  };
  const double strength = decohesion_.strength(s.decohesion, s.cohesive_strength);
  const double rounding = 1e-13 * (s.cohesive_strength + effective(traction_at(0.0)));

  // Below the strength: elastic with the opening frozen (the norm of a straight path is convex, so the end
  // tells).
  if (effective(traction_at(end)) <= strength + rounding) {
    s.elastic_strain += end * strain;
    return end;
  }
  // (An equilibrium that was solved for may fall short of the strength by rounding.)
  if (effective(traction_at(0.0)) < strength - 1e-10 * s.cohesive_strength - rounding) {
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
  const double estimate = wanted / (decohesion_.reference_opening() * std::max(denominator, 1e-300));
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
      surface += decohesion_.reference_opening() * s.cohesive_strength * decohesion_.viscosity() * growth *
                 growth / (f * duration);
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
  const double last = separated_at - 1e-12 * step;
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

/// Snap-back at constant strain: to the next equilibrium (q < 1), or to separation.
template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::snap_back(CompositeState& s, const Moduli& moduli, Dissipation& dissipation) const {
  const DecohesionPlane plane{s.normal};
  // A touch more than the traction at hand leaves the equilibrium that is lost.
  PlaneTraction pushed = traction(plane, s.elastic_strain, moduli);
  const double carried = decohesion_.effective_traction(pushed.normal, pushed.tangential);
  const double strength = decohesion_.strength(s.decohesion, s.cohesive_strength);
  const double push = (1.0 + 1e-10) * (carried > 0.0 ? std::max(1.0, strength / carried) : 1.0);
  pushed.normal *= push, pushed.tangential *= push;
  const DecohesionLaw::Advance next =
      decohesion_.advance(s.decohesion, s.cohesive_strength, pushed, s.effective_length, 0.0);
  if (next.separates) {
    separate(s, moduli, dissipation);
    return;
  }
  const double before = moduli.energy(s.elastic_strain);
  const double surface =
      decohesion_.surface_energy(s.decohesion, next.decohesion, s.cohesive_strength) / s.effective_length;
  open_plane(s, next);
  const double excess = std::max(0.0, before - moduli.energy(s.elastic_strain) - surface);
  dissipation.fracture += surface + excess;
  dissipation.snap_back += excess;
}

/// Opens the plane at constant strain.
template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::open_plane(CompositeState& s, const DecohesionLaw::Advance& next) const {
  const DecohesionPlane plane{s.normal};
  s.elastic_strain -= plane.jump_strain(next.normal_opening, next.tangential_opening, s.effective_length);
  s.decohesion = next.decohesion;
  s.opening_n += next.normal_opening;
  s.opening_t += next.tangential_opening;
}

/// lambda := 1: the traction on the plane is released. A snap-back sets free more than eq. 13 asks for.
template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::separate(CompositeState& s, const Moduli& moduli, Dissipation& dissipation) const {
  const double regular =
      decohesion_.surface_energy(s.decohesion, 1.0, s.cohesive_strength) / s.effective_length;
  const double before = moduli.energy(s.elastic_strain);
  s.decohesion = 1.0;
  relax_crack(s);
  const double excess = std::max(0.0, before - secant_moduli(s).energy(s.elastic_strain) - regular);
  dissipation.fracture += regular + excess;
  dissipation.snap_back += excess;
}

/// Opens, slides or closes the crack until its faces carry no traction, or only pressure once closed
/// (frictionless).
template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::relax_crack(CompositeState& s) const {
  const DecohesionPlane plane{s.normal};
  const double length = s.effective_length;
  bool tension = trace(s.elastic_strain) > 0.0;
  // The traction is a monotone, piecewise linear function of the opening (two bulk moduli): at most one
  // change of side.
  for (int side = 0; side < 2; ++side) {
    const Moduli moduli = secant(tension, s.crack_density);
    const PlaneTraction t = traction(plane, s.elastic_strain, moduli);
    const double opening = t.normal_stiffness > 0.0 ? length * t.normal / t.normal_stiffness : 0.0;
    const double sliding =
        t.tangential_stiffness > 0.0 ? length * t.tangential / t.tangential_stiffness : 0.0;
    const double normal = std::max(opening, -s.opening_n);
    const SymmetricTensor relaxed = s.elastic_strain - plane.jump_strain(normal, sliding, length);
    if (side == 1 || (trace(relaxed) > 0.0) == tension) {
      s.elastic_strain = relaxed;
      s.opening_n = normal == -s.opening_n ? 0.0 : s.opening_n + normal;
      s.opening_t += sliding;
      return;
    }
    tension = !tension;
  }
}

/// A separated plane over `strain`; returns the fraction at which an open crack closed, or -1.
template <bool D, Yielding Y, bool C>
double Composite<D, Y, C>::advance_separated(CompositeState& s, const SymmetricTensor& strain) const {
  const double gap = s.opening_n;
  const DecohesionPlane plane{s.normal};
  const PlaneTraction change = traction(plane, strain, secant_moduli(s));
  s.elastic_strain += strain;
  relax_crack(s);
  if (!(gap > 0.0) || s.opening_n > 0.0) return -1.0;
  // Between traction-free faces the gap shrinks linearly along the path until they meet.
  const double closing = -change.normal * s.effective_length;
  return closing > 0.0 ? std::clamp(gap * change.normal_stiffness / closing, 0.0, 1.0) : 1.0;
}

/// Plastic flow of a localised point, and what it does to its faces, told at `fraction` of the increment.
template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::flow_behind_crack(CompositeState& s, double outside_before, double fraction,
                                           PointReport& report) const {
  if constexpr (has_yield) {
    const double flowed = s.plastic_strain, gap = s.opening_n;
    flow_behind_crack(s, outside_before, report.dissipation);
    if (flowed == 0.0 && s.plastic_strain > 0.0) report.record(EventKind::yield, fraction);
    if (is_separated(s) && gap > 0.0 && s.opening_n == 0.0) report.record(EventKind::closure, fraction);
  }
}

/// Plastic flow of a localised point: behind a separated plane the faces stay free of traction while the
/// material flows. outside_before: what of the violation (Pa) falls onto the surface at once and loses all
/// its energy; the rest flows along it.
template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::flow_behind_crack(CompositeState& s, double outside_before,
                                           Dissipation& dissipation) const {
  const auto excess = [&](const CompositeState& c) {  // > 0 outside the yield surface, Pa
    const bool tension = trace(c.elastic_strain) > 0.0;
    return surface_acts(tension) ? yield_function(c, secant(tension, c.crack_density)) : 0.0;
  };
  const double tolerance = 1e-9 * elastic_.shear * norm(deviator(s.elastic_strain));
  const double violated = excess(s);
  if (!(violated > tolerance)) return;
  if (!is_separated(s)) {
    dissipation.plastic += flow(s, secant(trace(s.elastic_strain) > 0.0, s.crack_density), outside_before);
    return;
  }

  // Flow and traction-free faces are met in turn. What a unit of flow took off the excess the last time, the
  // faces' answer included, tells how much flow the next turn needs, forth or back.
  const double stored = stored_energy(s), flowed_before = s.plastic_strain;
  double value = violated, resistance = 1.0;  // relative to that without faces
  SymmetricTensor flowed{};                   // plastic strain
  for (int turn = 0; turn < 50 && std::abs(value) > tolerance; ++turn) {
    const double wanted = value / resistance;
    flowed += flow_along_deviator(s, wanted);
    relax_crack(s);
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
bool Composite<D, Y, C>::fell_behind_crack(const CompositeState& s, double flowed_before) const {
  if constexpr (Y == Yielding::von_mises) {
    const double softest = std::max(flowed_before, von_mises_.peak_strain());
    EvolutionMode mode = localised_mode(s);
    mode.hardening_modulus = von_mises_.modulus(softest);
    return s.plastic_strain > softest && mode.hardening_modulus < 0.0 && falls_through(mode, s);
  } else {
    return false;
  }
}

/// Plastic flow that lowers the stress measure by `excess` (Pa) when no face moves and the strength stays; at
/// most half of the deviator, which is to keep its direction. Returns the plastic strain.
template <bool D, Yielding Y, bool C>
SymmetricTensor Composite<D, Y, C>::flow_along_deviator(CompositeState& s, double excess) const {
  const Moduli moduli = secant(trace(s.elastic_strain) > 0.0, s.crack_density);
  const SymmetricTensor direction = flow_direction(s);  // per unit of |d eps_p|
  const double resistance = contract(yield_gradient(s, moduli), direction);
  if (!(resistance > 0.0)) return {};
  const double amount = std::min(excess / resistance, 0.5 * norm(deviator(s.elastic_strain)));
  s.elastic_strain -= amount * direction;
  s.plastic_strain += amount;
  return amount * direction;
}

}  // namespace vitrum
