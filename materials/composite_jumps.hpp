#pragma once
#include "materials/composite.hpp"

// What happens to a state at one instant, and what asks for it: falls onto the yield surface, the plane's
// birth, snap-back and separation.

namespace vitrum {

/// Shear that only tension allowed, or an initial stress, falls onto the yield surface at constant strain.
template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::fall_onto_surface(const EvolutionMode& mode, PointState& s, double fraction,
                                           PointReport& report) const {
  if (!surface_acts(mode.tension)) return;
  const Moduli m = secant(mode.tension, s.crack_density);
  const double excess = yield_function(s, m);
  if (!(excess > 1e-9 * m.shear * norm(deviator(s.elastic_strain)))) return;
  if (C && mode.separated())
    flow_behind_crack(s, excess, report.dissipation);
  else
    report.dissipation.plastic += flow(s, m, excess);
  report.record(EventKind::yield, fraction);
}

/// Whether the strength falls faster than elastic unloading at constant strain.
template <bool D, Yielding Y, bool C>
bool Composite<D, Y, C>::falls_through(const EvolutionMode& mode, const PointState& s) const {
  const Moduli m = secant(mode.tension, s.crack_density);
  SymmetricTensor given = flow_direction(s);
  if constexpr (C) {
    double gap = 0.0, slip = 0.0;
    if (mode.separated()) given = give_way(mode, s, m, given, gap, slip);
  }
  return contract(yield_gradient(s, m), given) + VonMisesLaw::factor * mode.hardening_modulus <= 0.0;
}

/// Softening faster than elasticity unloads: the stress falls at constant strain to where the strength meets
/// it.
template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::fall_at_constant_strain(const EvolutionMode& mode, PointState& s,
                                                 PointReport& report) const {
  const double stored = stored_energy(s);
  if (!C || !mode.separated()) {
    s.elastic_strain += 1e-12 * deviator(s.elastic_strain);
    report.dissipation.plastic += flow(s, secant(mode.tension, s.crack_density), 0.0);
    return;
  }
  if constexpr (C) {
    // Behind traction-free faces, which give way as it falls: in small steps to the end of the branch, or
    // until the stress is inside again.
    constexpr int steps = 64;
    const double step = (mode.branch_end - s.plastic_strain) / steps;
    for (int i = 0; i < steps; ++i) {
      const PointState before = s;
      s.elastic_strain -= std::min(step, norm(deviator(s.elastic_strain))) * flow_direction(s);
      s.plastic_strain = i + 1 == steps ? mode.branch_end : s.plastic_strain + step;
      relax_crack(s);
      const bool tension = trace(s.elastic_strain) > 0.0;
      if (i > 0 && yield_function(s, secant(tension, s.crack_density)) < 0.0) {
        s = before;
        break;
      }
    }
    report.dissipation.plastic += std::max(0.0, stored - stored_energy(s));
    Dissipation beyond;
    flow_behind_crack(s, std::numeric_limits<double>::infinity(), beyond);
    report.dissipation += beyond;
  }
}

/// Whether the plane loses its equilibrium even where the material behind it does not flow.
template <bool D, Yielding Y, bool C>
bool Composite<D, Y, C>::snaps_back_alone(EvolutionMode mode, const PointState& s,
                                          const StrainPath& path) const {
  mode.flowing = false;
  return !(rates(mode, s, path).fraction > 0.0);
}

/// Flow raises the traction on the plane, and its opening the stress measure, faster than both soften: the
/// point falls at constant strain. It flows in small steps to the end of the branch, or until the stress is
/// inside again, while the plane opens as its strength demands, if need be until it separates.
template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::fall_with_plane(EvolutionMode& mode, PointState& s, double fraction,
                                         PointReport& report) const {
  if constexpr (Y == Yielding::von_mises && C) {
    constexpr int steps = 64;
    const Moduli m = secant(mode.tension, s.crack_density);
    const DecohesionPlane plane{s.normal_r, s.normal_z};
    const double stored = stored_energy(s), start = s.decohesion;
    const double span = std::min(mode.branch_end - s.plastic_strain, norm(deviator(s.elastic_strain)));
    bool separates = false;
    const auto follow = [&] {
      const PlaneTraction t = traction(plane, s.elastic_strain, m);
      if (decohesion_.effective_traction(t.normal, t.tangential) <=
          decohesion_.strength(s.decohesion, s.cohesive_strength))
        return;
      const DecohesionLaw::Advance next =
          decohesion_.advance(s.decohesion, s.cohesive_strength, t, s.effective_length, 0.0);
      separates = next.separates;
      if (separates) return;
      s.elastic_strain -= plane.jump_strain(next.normal_opening, next.tangential_opening, s.effective_length);
      s.decohesion = next.decohesion;
      s.opening_n += next.normal_opening, s.opening_t += next.tangential_opening;
    };
    const double end = s.plastic_strain + span;
    for (int i = 0; i < steps && !separates && (i == 0 || yield_function(s, m) > 0.0); ++i) {
      s.elastic_strain -= std::min(span / steps, norm(deviator(s.elastic_strain))) * flow_direction(s);
      s.plastic_strain = i + 1 == steps ? end : s.plastic_strain + span / steps;
      follow();
    }
    // What is still outside at the end of the branch falls on along the next one.
    constexpr int most_turns = 50;
    const double tolerance = 1e-9 * m.shear * norm(deviator(s.elastic_strain));
    for (int turn = 0; turn < most_turns && !separates && yield_function(s, m) > tolerance; ++turn) {
      flow(s, m, 0.0);
      follow();
    }
    const double surface =
        decohesion_.surface_energy(start, s.decohesion, s.cohesive_strength) / s.effective_length;
    report.dissipation.fracture += surface;
    report.dissipation.plastic += std::max(0.0, stored - stored_energy(s) - surface);
    mode.plane = EvolutionMode::Plane::held;
    if (separates) separate_plane(mode, s, fraction, report);
  }
}

template <bool D, Yielding Y, bool C>
bool Composite<D, Y, C>::localises(const EvolutionMode& mode, const PointState& s) const {
  if constexpr (D && C)
    if (mode.damaging && s.crack_density > 0.0 && damage_localisation(s) <= 0.0) return true;
  if constexpr (Y == Yielding::von_mises && C)
    if (mode.flowing && mode.hardening_modulus < 0.0 &&
        flow_localisation(s, secant(mode.tension, s.crack_density), mode.hardening_modulus) <= 0.0)
      return true;
  return false;
}

template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::localise(EvolutionMode& mode, PointState& s, double fraction,
                                  PointReport& report) const {
  if constexpr (C) {
    start_decohesion(mode.tension, mode.damaging, s);
    mode.damaging = false;
    mode.plane = EvolutionMode::Plane::held;
    report.record(EventKind::localisation, fraction);
  }
}

/// Snap-back at constant strain: to the next equilibrium (q < 1), or to separation.
template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::release_plane(EvolutionMode& mode, PointState& s, double fraction,
                                       PointReport& report) const {
  if constexpr (C) {
    snap_back(s, secant(mode.tension, s.crack_density), report.dissipation);
    mode.plane = EvolutionMode::Plane::held;
    if (is_separated(s)) enter_separated(mode, s, fraction, report);
  }
}

template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::separate_plane(EvolutionMode& mode, PointState& s, double fraction,
                                        PointReport& report) const {
  if constexpr (C) {
    separate(s, secant(mode.tension, s.crack_density), report.dissipation);
    enter_separated(mode, s, fraction, report);
  }
}

/// The plane has just separated.
template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::enter_separated(EvolutionMode& mode, const PointState& s, double fraction,
                                         PointReport& report) const {
  mode.plane = s.opening_n > 0.0 ? EvolutionMode::Plane::open : EvolutionMode::Plane::closed;
  report.record(EventKind::separation, fraction);
}

template <bool D, Yielding Y, bool C>
bool Composite<D, Y, C>::shear_carries_strength(const EvolutionMode& mode, const PointState& s) const {
  const PlaneTraction t =
      traction({s.normal_r, s.normal_z}, s.elastic_strain, secant(mode.tension, s.crack_density));
  return mode.viscous || decohesion_.effective_traction(0.0, t.tangential) >
                             0.5 * decohesion_.strength(s.decohesion, s.cohesive_strength);
}

}  // namespace vitrum
