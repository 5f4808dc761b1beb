#pragma once
#include "materials/composite/models.hpp"

// The plane of decohesion: its birth, and what it does to a state at one instant.

namespace vitrum {

/// Largest normal strain among the planes that are searched.
template <bool D, Yielding Y, bool C>
double CompositeModels<D, Y, C>::largest_normal_strain(const SymmetricTensor& e) const {
  const double in_plane = 0.5 * (e.rr + e.zz) + std::sqrt(0.25 * (e.rr - e.zz) * (e.rr - e.zz) + e.rz * e.rz);
  return decohesion_.parameters().search_all_planes ? std::max(in_plane, e.tt) : in_plane;
}

/// (The hoop direction is a principal one.)
template <bool D, Yielding Y, bool C>
double CompositeModels<D, Y, C>::least_principal_strain(const SymmetricTensor& e) {
  const double in_plane = 0.5 * (e.rr + e.zz) - std::sqrt(0.25 * (e.rr - e.zz) * (e.rr - e.zz) + e.rz * e.rz);
  return std::min(in_plane, e.tt);
}

/// The largest compressive principal stress under tension, over 2 G_bar and the size of the strain; negative
/// where there is none. (G_bar itself may vanish.)
template <bool D, Yielding Y, bool C>
double CompositeModels<D, Y, C>::compression(const CompositeState& s) const {
  const SymmetricTensor& e = s.elastic_strain;
  const double lateral = damage_.lateral_ratio(s.crack_density / crack_density_limit);
  return -(lateral * trace(e) + least_principal_strain(e)) / norm(e);
}

/// Whether a principal stress is compressive in every state between two of a straight piece: the least
/// principal strain changes by no more than the strain does, the others are monotone.
template <bool D, Yielding Y, bool C>
bool CompositeModels<D, Y, C>::stays_compressed(const CompositeState& from, const CompositeState& to) const {
  const SymmetricTensor &a = from.elastic_strain, &b = to.elastic_strain;
  const double lateral = std::max(damage_.lateral_ratio(from.crack_density / crack_density_limit),
                                  damage_.lateral_ratio(to.crack_density / crack_density_limit));
  const double traces =
      lateral * (lateral > 0.0 ? std::max(trace(a), trace(b)) : std::min(trace(a), trace(b)));
  const double least = std::max(least_principal_strain(a), least_principal_strain(b)) + 0.5 * norm(b - a);
  return traces + least < -tolerance::on_surface * std::max(norm(a), norm(b));
}

/// <= 0 where growing damage admits a discontinuity (Phi), and the scene's reading of the paper a
/// localisation.
template <bool D, Yielding Y, bool C>
double CompositeModels<D, Y, C>::damage_localisation(const CompositeState& s) const {
  const SymmetricTensor& e = s.elastic_strain;
  if (!(trace(e) > 0.0)) return 1.0;
  const double phi =
      damage_.bifurcation(s.crack_density / crack_density_limit, trace(e), largest_normal_strain(e));
  if (decohesion_.parameters().partial_compression) return phi;
  // A stress that vanishes is no compression, whatever rounding makes of it.
  return std::max(phi, compression(s) - tolerance::on_surface);
}

/// <= 0 where softening flow admits a discontinuity (H >= H_cr, eq. 25).
template <bool D, Yielding Y, bool C>
double CompositeModels<D, Y, C>::flow_localisation(const CompositeState& s, const Moduli& m,
                                                   double modulus) const {
  const CriticalPlane plane = von_mises_critical_plane(2.0 * m.shear * deviator(s.elastic_strain), m,
                                                       VonMisesLaw::tangent_drop_of(m.shear, modulus),
                                                       decohesion_.parameters().search_all_planes);
  return 1.0 - plane.severity;
}

/// Fixes plane, strength (eq. 18) and effective length from the state at localisation. Where E of eq. 10 is
/// that of the virgin material, the stress keeps: what damage had added to the elastic strain stays for good,
/// and so does the energy that it stored.
template <bool D, Yielding Y, bool C>
void CompositeModels<D, Y, C>::start_decohesion(bool tension, [[maybe_unused]] bool damage_grows,
                                                CompositeState& s,
                                                [[maybe_unused]] Dissipation& dissipation) const {
  const Moduli moduli = secant(tension, s);
  const bool all = decohesion_.parameters().search_all_planes;
  double best = std::numeric_limits<double>::infinity();
  if constexpr (D) {
    if (tension && damage_grows) {
      const InPlanePrincipal p = in_plane_principal(s.elastic_strain);
      const bool hoop = all && s.elastic_strain.tt > p.major;
      const double largest = hoop ? s.elastic_strain.tt : p.major;
      best = damage_.bifurcation(s.crack_density / crack_density_limit, trace(s.elastic_strain), largest);
      s.normal = hoop ? PlaneVector{} : PlaneVector{p.direction_r, p.direction_z};
    }
  }
  if constexpr (Y == Yielding::von_mises) {
    if (von_mises_.modulus(s.plastic_strain) < 0.0) {
      const CriticalPlane plane =
          von_mises_critical_plane(2.0 * moduli.shear * deviator(s.elastic_strain), moduli,
                                   von_mises_.tangent_drop(moduli.shear, s.plastic_strain), all);
      if (1.0 - plane.severity < best) s.normal = plane.normal;
    }
  }
  const DecohesionPlane plane{s.normal};
  const PlaneTraction t = traction(plane, s.elastic_strain, moduli);
  s.cohesive_strength = decohesion_.effective_traction(t.normal, t.tangential);
  s.effective_length = plane.effective_length(cell_);
  if constexpr (D) {
    if (decohesion_.parameters().undamaged && s.crack_density > 0.0) {
      const SymmetricTensor kept = moduli.stress(s.elastic_strain);
      const double before = moduli.energy(s.elastic_strain);
      s.elastic_strain = elastic_.strain(kept);
      dissipation.damage += before - elastic_.energy(s.elastic_strain);
    }
  }
}

/// The mode of a localised point that is at rest.
template <bool D, Yielding Y, bool C>
CompositeMode CompositeModels<D, Y, C>::localised_mode(const CompositeState& s) const {
  using Plane = CompositeMode::Plane;
  CompositeMode mode;
  mode.tension = trace(s.elastic_strain) > 0.0;
  mode.viscous = decohesion_.viscosity() > 0.0;
  mode.plane = !is_separated(s) ? Plane::held : s.opening_n > 0.0 ? Plane::open : Plane::closed;
  return mode;
}

/// What is left of an elastic strain (or its rate) when the faces of a separated plane give way; `gap` and
/// `slip` get the jumps (m).
template <bool D, Yielding Y, bool C>
SymmetricTensor CompositeModels<D, Y, C>::strain_left_by_faces(const CompositeMode& mode,
                                                               const CompositeState& s, const Moduli& m,
                                                               const SymmetricTensor& strain, double& gap,
                                                               double& slip) const {
  const DecohesionPlane plane{s.normal};
  const double L = s.effective_length;
  if (const Separated bears = decohesion_.parameters().separated; bears != Separated::faces) {
    const bool is_closed = mode.plane == CompositeMode::Plane::closed;
    if (is_closed && is_rubble(s)) {
      gap = slip = 0.0;
      return mode.sheared < 1.0 ? mode.sheared * deviator(strain) + (trace(strain) / 3.0) * identity()
                                : strain;
    }
    const bool presses = bears == Separated::pressure && is_closed;
    gap = decohesion_.is_dust() ? L * plane.normal_part(strain) : presses ? 0.0 : L * trace(strain);
    slip = 2.0 * L * plane.tangential_part(strain);
    return (presses ? trace(strain) / 3.0 : 0.0) * identity() + 0.0 * strain;  // what is not a number shows
  }
  const PlaneTraction t = traction(plane, strain, m);
  gap = mode.plane == CompositeMode::Plane::open && t.normal_stiffness > 0.0
            ? L * t.normal / t.normal_stiffness
            : 0.0;
  slip = face_slip(mode, t, L);
  return strain - plane.jump_strain(gap, slip, L);
}

/// Sliding (m) of the faces of a separated plane while the traction changes so: all that shear asks for, or,
/// on closed faces that rub, what keeps the traction on Coulomb's cone; none where they stick.
template <bool D, Yielding Y, bool C>
double CompositeModels<D, Y, C>::face_slip(const CompositeMode& mode, const PlaneTraction& change,
                                           double length) const {
  if (!(change.tangential_stiffness > 0.0)) return 0.0;
  const double friction = mode.plane == CompositeMode::Plane::closed ? decohesion_.friction() : 0.0;
  if (friction > 0.0 && !mode.rubs()) return 0.0;
  const double driving =
      friction > 0.0 ? change.tangential + mode.slides * friction * change.normal : change.tangential;
  return length * driving / change.tangential_stiffness;
}

/// Whether the traction is more than the plane bears.
template <bool D, Yielding Y, bool C>
bool CompositeModels<D, Y, C>::is_overloaded(const CompositeMode& mode, const CompositeState& s) const {
  if (mode.viscous || !(mode.plane == CompositeMode::Plane::held || mode.decohering())) return false;
  const PlaneTraction t = traction(DecohesionPlane{s.normal}, s.elastic_strain, secant(mode.tension, s));
  return decohesion_.effective_traction(t.normal, t.tangential) >
         decohesion_.strength(s.decohesion, s.cohesive_strength) +
             tolerance::on_surface * s.cohesive_strength;
}

/// Opens the plane at constant strain.
template <bool D, Yielding Y, bool C>
void CompositeModels<D, Y, C>::open_plane(CompositeState& s, const DecohesionLaw::Advance& next) const {
  const DecohesionPlane plane{s.normal};
  s.elastic_strain -= plane.jump_strain(next.normal_opening, next.tangential_opening, s.effective_length);
  s.decohesion = next.decohesion;
  s.opening_n += next.normal_opening;
  s.opening_t += next.tangential_opening;
}

/// Snap-back at constant strain: to the next equilibrium (q < 1), or to separation.
template <bool D, Yielding Y, bool C>
void CompositeModels<D, Y, C>::snap_back(CompositeState& s, const Moduli& moduli,
                                         Dissipation& dissipation) const {
  const DecohesionPlane plane{s.normal};
  // A touch more than the traction at hand leaves the equilibrium that is lost.
  PlaneTraction pushed = traction(plane, s.elastic_strain, moduli);
  const double carried = decohesion_.effective_traction(pushed.normal, pushed.tangential);
  const double strength = decohesion_.strength(s.decohesion, s.cohesive_strength);
  const double push =
      (1.0 + tolerance::equilibrium) * (carried > 0.0 ? std::max(1.0, strength / carried) : 1.0);
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

/// Opens, slides or closes the crack until its faces carry no traction, or only pressure once closed
/// and what friction holds. Rubble has no faces: its void takes all the strain but what is left for pressure,
/// and, where it bears shear, what of the deviator comes after the closure.
template <bool D, Yielding Y, bool C>
void CompositeModels<D, Y, C>::free_faces(CompositeState& s) const {
  const DecohesionPlane plane{s.normal};
  const double length = s.effective_length;
  if (const Separated bears = decohesion_.parameters().separated; bears != Separated::faces) {
    const double volumetric = trace(s.elastic_strain) + s.opening_n / length;
    if (is_rubble(s) && volumetric < 0.0) {
      if (!(s.opening_n > 0.0)) return;
      const double after = volumetric / trace(s.elastic_strain);
      s.opening_t += 2.0 * length * (1.0 - after) * plane.tangential_part(s.elastic_strain);
      s.opening_n = 0.0;
      s.elastic_strain = after * s.elastic_strain;
      return;
    }
    s.opening_t += 2.0 * length * plane.tangential_part(s.elastic_strain);
    s.opening_n = decohesion_.is_dust() ? s.opening_n + length * plane.normal_part(s.elastic_strain)
                                        : length * std::max(volumetric, 0.0);
    const double pressed = bears == Separated::pressure ? std::min(volumetric, 0.0) / 3.0 : 0.0;
    s.elastic_strain = pressed * identity() + 0.0 * s.elastic_strain;  // what is not a number shows
    return;
  }
  bool tension = trace(s.elastic_strain) > 0.0;
  // The traction is a monotone, piecewise linear function of the opening (two bulk moduli): at most one
  // change of side.
  for (int side = 0; side < 2; ++side) {
    const Moduli moduli = secant(tension, s);
    const PlaneTraction t = traction(plane, s.elastic_strain, moduli);
    const double opening = t.normal_stiffness > 0.0 ? length * t.normal / t.normal_stiffness : 0.0;
    const double normal = std::max(opening, -s.opening_n);
    const double pressing =
        normal == -s.opening_n ? std::max(0.0, t.normal_stiffness * normal / length - t.normal) : 0.0;
    const double bearable = decohesion_.friction() * pressing;
    const double held = std::clamp(t.tangential, -bearable, bearable);
    const double sliding =
        t.tangential_stiffness > 0.0 ? length * (t.tangential - held) / t.tangential_stiffness : 0.0;
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

/// Share of its deviator that rubble bears, strained so from its apex.
template <bool D, Yielding Y, bool C>
double CompositeModels<D, Y, C>::share_of_shear(const CompositeState& s,
                                                const SymmetricTensor& strain) const {
  const Moduli m = secant(false, s);
  const double asked = std::sqrt(6.0) * m.shear * norm(deviator(strain));
  const double borne = -parameters_.drucker_prager->beta * m.bulk * trace(strain);
  return asked > borne ? borne / asked : 1.0;
}

/// lambda := 1: the traction on the plane is released. A snap-back sets free more than eq. 13 asks for.
template <bool D, Yielding Y, bool C>
void CompositeModels<D, Y, C>::separate(CompositeState& s, const Moduli& moduli,
                                        Dissipation& dissipation) const {
  const double regular =
      decohesion_.surface_energy(s.decohesion, 1.0, s.cohesive_strength) / s.effective_length;
  const double before = moduli.energy(s.elastic_strain);
  s.decohesion = 1.0;
  s.opening_n = std::max(s.opening_n, 0.0);  // faces that pressure has crushed touch where they are
  free_faces(s);
  const double excess = std::max(0.0, before - secant_moduli(s).energy(s.elastic_strain) - regular);
  dissipation.fracture += regular + excess;
  dissipation.snap_back += excess;
}

/// The plane has just separated.
template <bool D, Yielding Y, bool C>
void CompositeModels<D, Y, C>::enter_separated(CompositeMode& mode, const CompositeState& s, double fraction,
                                               PointReport& report) const {
  mode.plane = s.opening_n > 0.0 ? CompositeMode::Plane::open : CompositeMode::Plane::closed;
  if (is_rubble(s)) mode.tension = mode.plane == CompositeMode::Plane::open;
  report.record(EventKind::separation, fraction, stress(s));
}

}  // namespace vitrum
