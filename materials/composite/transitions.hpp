#pragma once
#include "materials/composite/evolution.hpp"

// From one mode to the next: which models act from here on.

namespace vitrum {

template <bool D, Yielding Y, bool C>
CompositeMode CompositeEvolution<D, Y, C>::first_mode(CompositeState& s, const StrainPath& path,
                                                      PointReport& report) const {
  using Plane = CompositeMode::Plane;
  CompositeMode mode;
  // Traction that the error of earlier increments left on open faces would push them open and shut for ever.
  // What it had stored is numerical error, and stays in the energy residual.
  if constexpr (C)
    if (is_separated(s)) free_faces(s);
  if constexpr (D) damage_.begin(trace(path.strain), path.duration, s.max_rate, s.mean_rate);
  const double start = trace(s.elastic_strain);
  mode.tension = start > 0.0 || (start == 0.0 && trace(path.strain) > 0.0);
  if constexpr (C)
    if (is_localised(s))
      mode.plane = !is_separated(s) ? Plane::held : s.opening_n > 0.0 ? Plane::open : Plane::closed;
  if (is_rubble(s) && mode.plane == Plane::open) mode.tension = true;  // its surface is that under pressure
  select_models(mode, std::nullopt, s, path, 0.0, report);
  return mode;
}

template <bool D, Yielding Y, bool C>
void CompositeEvolution<D, Y, C>::transition(CompositeMode& mode, CompositeGuard root, CompositeState& s,
                                             const StrainPath& path, double fraction,
                                             PointReport& report) const {
  using Plane = CompositeMode::Plane;
  // Rubble that is let go reaches its yield surface and its end at one place.
  if (is_rubble(s) && mode.plane == Plane::closed && trace(path.strain) > 0.0 &&
      trace(s.elastic_strain) >= -tolerance::rounding * norm(path.strain))
    root = CompositeGuard::opening;
  switch (root) {
    case CompositeGuard::mean_strain_sign:
      mode.tension = !mode.tension;
      break;
    case CompositeGuard::damage:
      mode.damaging = true;
      break;
    case CompositeGuard::exhausted:
      s.crack_density = crack_density_limit;
      mode.damaging = false;
      break;
    case CompositeGuard::strength_branch:
      s.plastic_strain = mode.branch_end;
      if (mode.hardening_modulus >= 0.0) report.record(EventKind::peak, fraction, stress(s));
      break;
    case CompositeGuard::localisation:
      localise(mode, s, fraction, report);
      break;
    case CompositeGuard::snap_back:
      if (mode.separated())
        fall_at_constant_strain(mode, s, fraction, report);
      else if (Y == Yielding::von_mises && mode.flowing && !snaps_back_alone(mode, s, path))
        fall_with_plane(mode, s, fraction, report);
      else
        release_plane(mode, s, fraction, report);
      break;
    case CompositeGuard::normal_traction_sign:
      // The traction equals the strength: where what is left by shear does not, it is the strength that has
      // vanished.
      if (shear_carries_strength(mode, s))
        mode.pulled = !mode.pulled;
      else
        separate_plane(mode, s, fraction, report);
      break;
    case CompositeGuard::separation:
      separate_plane(mode, s, fraction, report);
      break;
    case CompositeGuard::closure:
      s.opening_n = 0.0;
      mode.plane = Plane::closed;
      if (is_rubble(s)) mode.tension = false;
      report.record(EventKind::closure, fraction, stress(s));
      break;
    case CompositeGuard::opening:
      mode.plane = Plane::open;
      if (is_rubble(s)) mode.tension = true, s.elastic_strain = {};
      break;
    case CompositeGuard::slip:
    case CompositeGuard::stick:
    case CompositeGuard::yield:
    case CompositeGuard::unload:
    case CompositeGuard::decohesion:
    case CompositeGuard::opening_stops:
      break;
  }
  select_models(mode, root, s, path, fraction, report);
  if (root != CompositeGuard::mean_strain_sign) {
    mode.sliding = false;
  } else if (const double rate = trace(rates(mode, s, path).elastic_strain);
             mode.tension ? rate < 0.0 : rate > 0.0) {
    mode.tension = !mode.tension;
    mode.sliding = true;
    select_models(mode, root, s, path, fraction, report);
  }
}

/// Settles which laws act from here on, after the jumps that the state asks for.
template <bool D, Yielding Y, bool C>
void CompositeEvolution<D, Y, C>::select_models(CompositeMode& mode, std::optional<CompositeGuard> root,
                                                CompositeState& s, const StrainPath& path, double fraction,
                                                PointReport& report) const {
  if constexpr (D) select_damage(mode, s, path, fraction, report);
  fall_to_admissible_stress(mode, s, fraction, report);
  select_proportional(mode, s, path, fraction, report);
  // A jump may ask for another: a bounded number of times. What the event tells holds of the state before it.
  constexpr int most_jumps = 8;
  bool unloads = root == CompositeGuard::unload, stalls = root == CompositeGuard::opening_stops,
       reached = root == CompositeGuard::yield, rests = root == CompositeGuard::stick;
  bool yields = reached || s.plastic_strain == 0.0;  // is what flows from here on an event?
  for (int jumps = 0;; ++jumps) {
    using Plane = CompositeMode::Plane;
    if ((mode.plane == Plane::held || mode.decohering()) && strength_is_spent(s, path)) {
      separate_plane(mode, s, fraction, report);
      unloads = stalls = reached = rests = false;
    }
    const bool may_flow = !unloads && on_surface(mode, s, reached),
               may_open = !stalls && at_strength(mode, s);
    set_branch(mode, s);
    const bool runs_away = select_flow_and_opening(mode, s, path, may_flow, may_open, !rests);
    if (yields && mode.flowing) report.record(EventKind::yield, fraction, stress(s)), yields = false;
    if (reached && !mode.flowing) step_inside_surface(mode, s);
    if (jumps == most_jumps) {
      // What still falls does so when the next increment begins.
      mode.flowing =
          mode.flowing && !runs_away && !(Y == Yielding::von_mises && softens_past_equilibrium(mode, s));
      return;
    }
    if constexpr (C) {
      if (mode.plane == Plane::intact && localises(mode, s)) {
        localise(mode, s, fraction, report);
        continue;
      }
    }
    if (!perform_jump(mode, s, path, fraction, runs_away, report)) return;
    unloads = stalls = reached = rests = false;
  }
}

/// Whether what strength the plane has is the error of the integration, or of rounding (it localised next to
/// free of traction).
template <bool D, Yielding Y, bool C>
bool CompositeEvolution<D, Y, C>::strength_is_spent(const CompositeState& s, const StrainPath& path) const {
  return s.decohesion >= 1.0 - std::max(tolerance::rounding, 10.0 * path.tolerance) ||
         s.cohesive_strength <= tolerance::rounding * elastic_.shear;
}

/// Performs the jump that the state asks for, if any.
template <bool D, Yielding Y, bool C>
bool CompositeEvolution<D, Y, C>::perform_jump(CompositeMode& mode, CompositeState& s, const StrainPath& path,
                                               double fraction, bool runs_away, PointReport& report) const {
  if constexpr (C) {
    if (runs_away) {
      fall_with_plane(mode, s, fraction, report);
      return true;
    }
    if (mode.decohering() && !mode.viscous && !rates(mode, s, path).advances()) {
      release_plane(mode, s, fraction, report);
      return true;
    }
  }
  if constexpr (Y == Yielding::von_mises) {
    if (mode.flowing && softens_past_equilibrium(mode, s)) {
      fall_at_constant_strain(mode, s, fraction, report);
      return true;
    }
  }
  return false;
}

/// Rate and coefficient of eq. 7 on this side, and whether the crack density grows.
template <bool D, Yielding Y, bool C>
void CompositeEvolution<D, Y, C>::select_damage(CompositeMode& mode, CompositeState& s,
                                                const StrainPath& path, double fraction,
                                                PointReport& report) const {
  const double change = trace(path.strain);
  const bool can = mode.plane == CompositeMode::Plane::intact && mode.tension;
  if (!can) {
    mode.damaging = false;
    return;
  }
  damage_.grow(change, path.duration, s.max_rate, s.mean_rate);
  if (damage_.rate() == DamageRate::current && change > 0.0 && damage_at_once(s, fraction, report)) {
    mode.plane = CompositeMode::Plane::held;
    mode.damaging = false;
    return;
  }
  mode.coefficient = damage_.coefficient(damage_.effective_rate(s.max_rate));
  const double target = damage_.target(damaging_strain(s), mode.coefficient);
  const bool reached = mode.damaging || target >= s.crack_density * (1.0 - tolerance::rounding);
  const bool grows = reached && change > 0.0 && s.crack_density < crack_density_limit;
  if (grows && s.crack_density == 0.0) report.record(EventKind::damage, fraction, stress(s));
  mode.damaging = grows;
}

/// Whether the stress is not inside the yield surface, rounding aside.
template <bool D, Yielding Y, bool C>
bool CompositeEvolution<D, Y, C>::is_near_surface(const CompositeMode& mode, const CompositeState& s) const {
  if constexpr (has_yield) {
    if (!surface_acts(mode.tension, s)) return false;
    const Moduli m = secant(mode.tension, s);
    return yield_function(s, m) >= -tolerance::on_surface * m.shear * norm(deviator(s.elastic_strain));
  } else {
    return false;
  }
}

template <bool D, Yielding Y, bool C>
bool CompositeEvolution<D, Y, C>::on_surface(const CompositeMode& mode, const CompositeState& s,
                                             bool reached) const {
  return mode.sheared == 1.0 && surface_acts(mode.tension, s) &&
         (reached || mode.flowing || is_near_surface(mode, s));
}

template <bool D, Yielding Y, bool C>
bool CompositeEvolution<D, Y, C>::at_strength(const CompositeMode& mode, const CompositeState& s) const {
  if constexpr (C) {
    using Plane = CompositeMode::Plane;
    if (mode.plane != Plane::held && mode.plane != Plane::decohering) return false;
    const Moduli m = secant(mode.tension, s);
    const PlaneTraction t = traction(DecohesionPlane{s.normal}, s.elastic_strain, m);
    const double N = decohesion_.effective_traction(t.normal, t.tangential);
    return N > 0.0 && N >= decohesion_.strength(s.decohesion, s.cohesive_strength) -
                               tolerance::on_surface * s.cohesive_strength;
  } else {
    return false;
  }
}

/// Hardening, softening or residual branch of the strength.
template <bool D, Yielding Y, bool C>
void CompositeEvolution<D, Y, C>::set_branch(CompositeMode& mode, const CompositeState& s) const {
  if constexpr (Y == Yielding::von_mises) {
    mode.hardening_modulus = von_mises_.modulus(s.plastic_strain);
    mode.branch_end = s.plastic_strain < von_mises_.peak_strain() ? von_mises_.peak_strain()
                      : s.plastic_strain < von_mises_.floor_strain()
                          ? von_mises_.floor_strain()
                          : std::numeric_limits<double>::infinity();
  }
}

}  // namespace vitrum
