#pragma once
#include "materials/composite/evolution.hpp"

// What happens to a state at one instant, and the mode after it.

namespace vitrum {

/// After a jump, which may have left the yield surface to either side: what lies inside flows no more.
template <bool D, Yielding Y, bool C>
void CompositeEvolution<D, Y, C>::resume_after_jump(CompositeMode& mode, CompositeState& s, double fraction,
                                                    PointReport& report) const {
  fall_to_admissible_stress(mode, s, fraction, report);
  mode.flowing = mode.flowing && is_near_surface(mode, s);
}

/// Softening faster than elasticity unloads: the stress falls at constant strain to where the strength meets
/// it.
template <bool D, Yielding Y, bool C>
void CompositeEvolution<D, Y, C>::fall_at_constant_strain(CompositeMode& mode, CompositeState& s,
                                                          double fraction, PointReport& report) const {
  const double stored = stored_energy(s);
  if (!C || !mode.separated()) {
    s.elastic_strain += tolerance::rounding * deviator(s.elastic_strain);
    flow(s, secant(mode.tension, s), 0.0);
    report.dissipation.plastic += std::max(0.0, stored - stored_energy(s));
    resume_after_jump(mode, s, fraction, report);
    return;
  }
  if constexpr (C) {
    // Behind traction-free faces, which give way as it falls: in small steps to the end of the branch, or
    // until the stress is inside again.
    constexpr int steps = 64;
    const double step = (mode.branch_end - s.plastic_strain) / steps;
    for (int i = 0; i < steps; ++i) {
      const CompositeState before = s;
      s.elastic_strain -= std::min(step, norm(deviator(s.elastic_strain))) * flow_direction(s);
      s.plastic_strain = i + 1 == steps ? mode.branch_end : s.plastic_strain + step;
      free_faces(s);
      const bool tension = trace(s.elastic_strain) > 0.0;
      if (i > 0 && yield_function(s, secant(tension, s)) < 0.0) {
        s = before;
        break;
      }
    }
    report.dissipation.plastic += std::max(0.0, stored - stored_energy(s));
    Dissipation beyond;
    flow_behind_crack(s, mode.tension, std::numeric_limits<double>::infinity(), beyond);
    report.dissipation += beyond;
    resume_after_jump(mode, s, fraction, report);
  }
}

/// Whether the plane loses its equilibrium even where the material behind it does not flow.
template <bool D, Yielding Y, bool C>
bool CompositeEvolution<D, Y, C>::snaps_back_alone(CompositeMode mode, const CompositeState& s,
                                                   const StrainPath& path) const {
  mode.flowing = false;
  return !rates(mode, s, path).advances();
}

/// A bit of plastic flow at constant strain, after which the plane opens as its strength demands. False, with
/// the plane as it was, where no equilibrium is left to it.
template <bool D, Yielding Y, bool C>
bool CompositeEvolution<D, Y, C>::flow_with_plane(CompositeState& s, const Moduli& m, double amount) const {
  s.elastic_strain -= std::min(amount, norm(deviator(s.elastic_strain))) * flow_direction(s);
  s.plastic_strain += amount;
  const DecohesionPlane plane{s.normal};
  const PlaneTraction t = traction(plane, s.elastic_strain, m);
  if (decohesion_.effective_traction(t.normal, t.tangential) <=
      decohesion_.strength(s.decohesion, s.cohesive_strength))
    return true;
  const DecohesionLaw::Advance next =
      decohesion_.advance(s.decohesion, s.cohesive_strength, t, s.effective_length, 0.0);
  if (next.separates) return false;
  open_plane(s, next);
  return true;
}

/// Flow raises the traction on the plane, and its opening the stress measure, faster than both soften: the
/// point falls at constant strain. It flows along the branches of its strength in small steps, and the plane
/// opens with it, until the stress meets the yield surface from outside, or the plane separates.
template <bool D, Yielding Y, bool C>
void CompositeEvolution<D, Y, C>::fall_with_plane(CompositeMode& mode, CompositeState& s, double fraction,
                                                  PointReport& report) const {
  if constexpr (Y == Yielding::von_mises && C) {
    constexpr int branches = 3, steps = 64;
    const Moduli m = secant(mode.tension, s);
    const double stored = stored_energy(s), decohesion = s.decohesion;
    bool together = true, inside = false;
    for (int branch = 0; branch < branches && together && !inside; ++branch) {
      set_branch(mode, s);
      const double size = norm(deviator(s.elastic_strain));
      const bool to_end = mode.branch_end - s.plastic_strain <= size;
      const double amount = std::min(mode.branch_end - s.plastic_strain, size) / steps;
      for (int i = 0; i < steps && together && !inside; ++i) {
        const CompositeState before = s;
        together = flow_with_plane(s, m, amount);
        if (to_end && i + 1 == steps) s.plastic_strain = mode.branch_end;
        inside = together && yield_function(s, m) < 0.0;
        if (!inside) continue;
        // Back to where the stress met the surface, unless it has never been outside.
        const auto met = [&](double part) {
          CompositeState tried = before;
          return flow_with_plane(tried, m, part * amount) && yield_function(tried, m) < 0.0;
        };
        const double part = first_reached(0.0, 1.0, met);
        if (part < tolerance::jump) continue;
        s = before;
        flow_with_plane(s, m, part * amount);
      }
      if (to_end && !inside && mode.hardening_modulus > 0.0)
        report.record(EventKind::peak, fraction, stress(s));
    }
    const double surface =
        decohesion_.surface_energy(decohesion, s.decohesion, s.cohesive_strength) / s.effective_length;
    report.dissipation.fracture += surface;
    report.dissipation.plastic += std::max(0.0, stored - stored_energy(s) - surface);
    mode.plane = CompositeMode::Plane::held;
    if (together)
      resume_after_jump(mode, s, fraction, report);
    else
      separate_plane(mode, s, fraction, report);
  }
}

template <bool D, Yielding Y, bool C>
bool CompositeEvolution<D, Y, C>::localises(const CompositeMode& mode, const CompositeState& s) const {
  if constexpr (D && C)
    if (mode.damaging && s.crack_density > 0.0 && damage_localisation(s) <= 0.0) return true;
  if constexpr (Y == Yielding::von_mises && C)
    if (mode.flowing && mode.hardening_modulus < 0.0 &&
        flow_localisation(s, secant(mode.tension, s), mode.hardening_modulus) <= 0.0)
      return true;
  return false;
}

template <bool D, Yielding Y, bool C>
void CompositeEvolution<D, Y, C>::localise(CompositeMode& mode, CompositeState& s, double fraction,
                                           PointReport& report) const {
  if constexpr (C) {
    start_decohesion(mode.tension, mode.damaging, s, report.dissipation);
    mode.damaging = false;
    mode.plane = CompositeMode::Plane::held;
    report.record(EventKind::localisation, fraction, stress(s));
  }
}

/// Snap-back at constant strain: to the next equilibrium (q < 1), or to separation.
template <bool D, Yielding Y, bool C>
void CompositeEvolution<D, Y, C>::release_plane(CompositeMode& mode, CompositeState& s, double fraction,
                                                PointReport& report) const {
  if constexpr (C) {
    snap_back(s, secant(mode.tension, s), report.dissipation);
    mode.plane = CompositeMode::Plane::held;
    if (is_separated(s)) enter_separated(mode, s, fraction, report);
    resume_after_jump(mode, s, fraction, report);
  }
}

template <bool D, Yielding Y, bool C>
void CompositeEvolution<D, Y, C>::separate_plane(CompositeMode& mode, CompositeState& s, double fraction,
                                                 PointReport& report) const {
  if constexpr (C) {
    separate(s, secant(mode.tension, s), report.dissipation);
    enter_separated(mode, s, fraction, report);
    resume_after_jump(mode, s, fraction, report);
  }
}

template <bool D, Yielding Y, bool C>
bool CompositeEvolution<D, Y, C>::shear_carries_strength(const CompositeMode& mode,
                                                         const CompositeState& s) const {
  const PlaneTraction t = traction(DecohesionPlane{s.normal}, s.elastic_strain, secant(mode.tension, s));
  return mode.viscous || decohesion_.effective_traction(0.0, t.tangential) >
                             0.5 * decohesion_.strength(s.decohesion, s.cohesive_strength);
}

}  // namespace vitrum
