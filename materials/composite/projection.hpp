#pragma once
#include "materials/composite/evolution.hpp"

// The drift of a solver's result off the surfaces that a mode keeps to.

namespace vitrum {

template <bool D, Yielding Y, bool C>
void CompositeEvolution<D, Y, C>::project(const CompositeMode& mode, CompositeState& s,
                                          const StrainPath&) const {
  if constexpr (C) {
    if (mode.decohering() && !mode.viscous) {
      const Moduli m = secant(mode.tension, s);
      const double u0 = decohesion_.opening(s.cohesive_strength);
      for (int i = 0; i < 2; ++i) {
        const Softening w = softening(mode, s, m);
        const double resistance = w.stiffness + w.slope;
        if (!(resistance > tolerance::ill_posed * w.stiffness))
          break;  // next to a snap-back the correction is ill-posed
        const double step = (w.drive.traction - w.strength) / resistance;
        if (!(std::abs(step) < tolerance::drift) || s.decohesion + step >= 1.0) break;
        s.decohesion += step;
        s.opening_n += step * u0 * w.drive.normal;
        s.opening_t += step * u0 * w.drive.tangential;
        s.elastic_strain -= step * w.jump;
      }
    }
  }
  for (int i = 0; i < 3; ++i) {
    if constexpr (C)
      if (mode.separated()) project_faces(mode, s);
    if constexpr (has_yield) {
      if (mode.flowing) {
        const Moduli m = secant(mode.tension, s);
        const SymmetricTensor direction = flow_direction(s);
        SymmetricTensor given = direction;
        double gap = 0.0, slip = 0.0;
        if constexpr (C)
          if (mode.separated()) given = strain_left_by_faces(mode, s, m, direction, gap, slip);
        const SymmetricTensor gradient = yield_gradient(s, m);
        double stiffness = contract(gradient, given);
        if constexpr (Y == Yielding::von_mises) stiffness += VonMisesLaw::factor * mode.hardening_modulus;
        if (!(stiffness > tolerance::ill_posed * contract(gradient, direction)))
          return;  // next to a snap-back, as above
        const double step = yield_function(s, m) / stiffness;
        if (!(std::abs(step) < norm(deviator(s.elastic_strain)))) return;  // no drift: the strength has gone
        s.elastic_strain -= step * given;
        s.plastic_strain += step;
        s.opening_n -= gap * step, s.opening_t -= slip * step;
      }
    }
    if (!mode.flowing || !mode.separated()) break;
  }
}

/// Faces that slide under friction keep to Coulomb's cone; all others are freed. (Rubble has none.)
template <bool D, Yielding Y, bool C>
void CompositeEvolution<D, Y, C>::project_faces(const CompositeMode& mode, CompositeState& s) const {
  if (mode.rubs()) {
    const DecohesionPlane plane{s.normal};
    const PlaneTraction t = traction(plane, s.elastic_strain, secant(mode.tension, s));
    const double slip = face_slip(mode, t, s.effective_length);
    s.elastic_strain -= plane.jump_strain(0.0, slip, s.effective_length);
    s.opening_t += slip;
  } else if (!is_rubble(s)) {
    free_faces(s);
  }
}

/// The path reached the yield surface by an error of the integration, or at too flat an angle for rounding to
/// tell that it does. It begins anew a rounding inside, so that no event function starts above zero, where
/// CVODE would never see it cross; what that takes from the stored energy is a rounding, too.
template <bool D, Yielding Y, bool C>
void CompositeEvolution<D, Y, C>::step_inside_surface(const CompositeMode& mode, CompositeState& s) const {
  if constexpr (has_yield) {
    const Moduli m = secant(mode.tension, s);
    const SymmetricTensor d = deviator(s.elastic_strain);
    const double slope = contract(yield_gradient(s, m), d);
    if (!(slope > 0.0)) return;
    const double excess = std::max(0.0, yield_function(s, m)) / slope;
    constexpr double rounding = 4.0 * std::numeric_limits<double>::epsilon();
    s.elastic_strain -=
        (excess + std::max(tolerance::rounding, rounding * norm(s.elastic_strain) / norm(d))) * d;
  }
}

}  // namespace vitrum
