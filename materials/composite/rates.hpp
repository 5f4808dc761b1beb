#pragma once
#include "materials/composite/evolution.hpp"

// Rates, their derivatives, and the guards of a mode.

namespace vitrum {

/// What drives a softening plane and how it answers.
template <bool D, Yielding Y, bool C>
auto CompositeEvolution<D, Y, C>::softening(const CompositeMode& mode, const CompositeState& s,
                                            const Moduli& m) const -> Softening {
  const DecohesionPlane plane{s.normal};
  Softening w;
  const PlaneTraction t = traction(plane, s.elastic_strain, m);
  w.drive = decohesion_.drive(t.normal, t.tangential, mode.pulled);
  const double u0 = decohesion_.opening(s.cohesive_strength);
  w.jump = plane.jump_strain(u0 * w.drive.normal, u0 * w.drive.tangential, s.effective_length);
  w.stiffness = traction_change(plane, w.drive, m, w.jump);
  w.slope = decohesion_.strength_slope(s.decohesion, s.cohesive_strength);
  w.strength = decohesion_.strength(s.decohesion, s.cohesive_strength);
  return w;
}

template <bool D, Yielding Y, bool C>
CompositeRates CompositeEvolution<D, Y, C>::rates(const CompositeMode& mode, const CompositeState& s,
                                                  const StrainPath& path) const {
  CompositeRates r;
  const Moduli m = secant(mode.tension, s);
  SymmetricTensor strain = path.strain;
  double thinning = 0.0;  // loss of |s| by the loss of stiffness, Pa per unit of the fraction
  if constexpr (D) {
    if (mode.damaging) {
      const double t = trace(s.elastic_strain);
      r.crack_density =
          damage_.strain_of(damage_.target_slope(damaging_strain(s), mode.coefficient) * trace(path.strain)) /
          s.strength_factor;
      const double x_rate = r.crack_density / crack_density_limit;
      const Moduli slope = damage_.moduli_derivative(std::min(s.crack_density / crack_density_limit, 1.0));
      const SymmetricTensor d = deviator(s.elastic_strain);
      const double square = contract(d, d);
      r.damage = x_rate * (-0.5 * slope.bulk * t * t - slope.shear * square);
      if constexpr (has_yield) thinning = 2.0 * slope.shear * std::sqrt(square) * x_rate;
    }
  }

  SymmetricTensor direction{}, given{},
      gradient{};  // d eps_p / d I, what of it stays elastic strain, d f / d e
  double plastic_stiffness = 1.0, gap_of_flow = 0.0, slip_of_flow = 0.0;
  if constexpr (has_yield) {
    if (mode.flowing) {
      direction = given = flow_direction(s);
      gradient = yield_gradient(s, m);
    }
  }
  if constexpr (C) {
    if (mode.separated()) {
      strain = strain_left_by_faces(mode, s, m, strain, r.opening_n, r.opening_t);
      if (mode.flowing) given = strain_left_by_faces(mode, s, m, direction, gap_of_flow, slip_of_flow);
    }
  }
  if constexpr (has_yield) {
    if (mode.flowing) {
      plastic_stiffness = contract(gradient, given);
      if constexpr (Y == Yielding::von_mises)
        plastic_stiffness += VonMisesLaw::factor * mode.hardening_modulus;
    }
  }

  double flow_rate = 0.0, opening_rate = 0.0;  // dI and d lambda
  SymmetricTensor jump{};
  const double flow_drive = mode.flowing ? contract(gradient, strain) + thinning : 0.0;
  if constexpr (C) {
    if (mode.decohering()) {
      const Softening w = softening(mode, s, m);
      const DecohesionPlane plane{s.normal};
      jump = w.jump;
      const double u0_over_length = decohesion_.opening(s.cohesive_strength) / s.effective_length;
      if (mode.viscous) {
        opening_rate =
            path.duration * (w.drive.traction - w.strength) / (decohesion_.viscosity() * s.cohesive_strength);
        if (mode.flowing)
          flow_rate = (flow_drive - opening_rate * contract(gradient, jump)) / plastic_stiffness;
        r.fracture = w.drive.traction * u0_over_length * opening_rate;
      } else {
        // Consistency on the plane and, where the material flows, on the yield surface; divided not by the
        // determinant but by its part without softening, which stays positive up to a snap-back and beyond.
        const double a11 = w.stiffness + w.slope, b1 = traction_change(plane, w.drive, m, path.strain);
        if (mode.flowing) {
          const double a12 = traction_change(plane, w.drive, m, direction), a21 = contract(gradient, jump);
          const double reference = w.stiffness * plastic_stiffness;
          r.fraction = (a11 * plastic_stiffness - a12 * a21) / reference;
          opening_rate = (b1 * plastic_stiffness - a12 * flow_drive) / reference;
          flow_rate = (a11 * flow_drive - a21 * b1) / reference;
        } else {
          r.fraction = a11 / w.stiffness;
          opening_rate = b1 / w.stiffness;
        }
        r.fracture = w.strength * u0_over_length * opening_rate;
      }
      r.decohesion = opening_rate;
      r.opening_n = decohesion_.opening(s.cohesive_strength) * w.drive.normal * opening_rate;
      r.opening_t = decohesion_.opening(s.cohesive_strength) * w.drive.tangential * opening_rate;
    }
  }
  if (mode.flowing && !mode.decohering()) {
    // As above: divided by the part without softening where the faces of a plane give way.
    const double reference = mode.may_snap_back() ? contract(gradient, direction) : plastic_stiffness;
    r.fraction = plastic_stiffness / reference;
    flow_rate = flow_drive / reference;
    r.opening_n *= r.fraction, r.opening_t *= r.fraction;
  }
  if constexpr (C && Y == Yielding::drucker_prager)
    if (mode.sheared < 1.0) r.plastic_strain = (1.0 - mode.sheared) * norm(deviator(path.strain));
  r.elastic_strain = r.fraction * strain - opening_rate * jump - flow_rate * given;
  if constexpr (has_yield) {
    if (mode.flowing) {
      r.plastic_strain = flow_rate;
      r.plastic = flow_rate * contract(m.stress(s.elastic_strain), direction);
      r.opening_n -= gap_of_flow * flow_rate, r.opening_t -= slip_of_flow * flow_rate;
    }
  }
  if constexpr (C)
    if (mode.rubs())
      r.plastic += traction(DecohesionPlane{s.normal}, s.elastic_strain, m).tangential * r.opening_t /
                   s.effective_length;
  return r;
}

template <bool D, Yielding Y, bool C>
OpeningJacobian CompositeEvolution<D, Y, C>::opening_jacobian([[maybe_unused]] const CompositeMode& mode,
                                                              [[maybe_unused]] const CompositeState& s,
                                                              [[maybe_unused]] const StrainPath& path) const {
  OpeningJacobian J{};
  if constexpr (C) {
    const Moduli m = secant(mode.tension, s);
    const PlaneTraction t = traction(DecohesionPlane{s.normal}, s.elastic_strain, m);
    const PlaneDrive drive = decohesion_.drive(t.normal, t.tangential, mode.pulled);
    const double N = drive.traction;
    if (!(N > 0.0)) return J;
    const double u0 = decohesion_.opening(s.cohesive_strength), L = s.effective_length;
    const double per_traction = path.duration / (decohesion_.viscosity() * s.cohesive_strength);
    const double opening_rate = per_traction * (N - decohesion_.strength(s.decohesion, s.cohesive_strength));
    // Openings unload: d tau_i / d w_i = -Q_i / L, and N' = m . tau'.
    const double qn = -t.normal_stiffness / L, qt = -t.tangential_stiffness / L;
    const std::array<double, 3> of_N{0.0, drive.normal * qn, drive.tangential * qt};
    const double c = 1.0 / (decohesion_.parameters().mode_ratio * decohesion_.parameters().mode_ratio);
    for (std::size_t j = 0; j < 3; ++j) {
      const double of_strength = j == 0 ? decohesion_.strength_slope(s.decohesion, s.cohesive_strength) : 0.0;
      const double of_rate = per_traction * (of_N[j] - of_strength);
      // m = (tau_n, c tau_t) / N
      const double of_normal = ((j == 1 && mode.pulled ? qn : 0.0) - drive.normal * of_N[j]) / N;
      const double of_tangential = ((j == 2 ? c * qt : 0.0) - drive.tangential * of_N[j]) / N;
      J[0][j] = of_rate;
      J[1][j] = u0 * (drive.normal * of_rate + of_normal * opening_rate);
      J[2][j] = u0 * (drive.tangential * of_rate + of_tangential * opening_rate);
      J[3][j] = u0 / L * (N * of_rate + of_N[j] * opening_rate);
    }
  }
  return J;
}

template <bool D, Yielding Y, bool C>
void CompositeEvolution<D, Y, C>::guards(const CompositeMode& mode, const CompositeState& s,
                                         const StrainPath& path, Guards& g) const {
  g.count = 0;
  const Moduli m = secant(mode.tension, s);
  const double size = norm(path.strain), per_size = size > 0.0 ? 1.0 / size : 0.0;
  const double t = trace(s.elastic_strain);
  const bool intact = mode.plane == CompositeMode::Plane::intact;
  const bool has_faces = !(C && mode.separated() && !decohesion_.has_faces());
  if (!mode.sliding && has_faces &&
      (Y == Yielding::drucker_prager || (D && (intact || s.crack_density > 0.0))))
    g.add(CompositeGuard::mean_strain_sign, (mode.tension ? -t : t) * per_size);
  if constexpr (D) {
    if (mode.damaging) {
      g.add(CompositeGuard::exhausted, s.crack_density / crack_density_limit - 1.0);
      if constexpr (C) g.add(CompositeGuard::localisation, -damage_localisation(s));
    } else if (intact && mode.tension && trace(path.strain) > 0.0 && s.crack_density < crack_density_limit) {
      g.add(
          CompositeGuard::damage,
          (damage_.strain_of(t) - s.strength_factor * damage_.strain_at(s.crack_density, mode.coefficient)) *
              per_size);
    }
  }
  const bool needs_rates = mode.flowing || (mode.decohering() && !mode.viscous) || mode.rubs();
  const CompositeRates r = needs_rates ? rates(mode, s, path) : CompositeRates{};
  if constexpr (has_yield) {
    if (mode.flowing) {
      g.add(CompositeGuard::unload, -r.plastic_strain * per_size);
      if (mode.separated() && mode.may_snap_back())
        g.add(CompositeGuard::snap_back, 0.5 * CompositeRates::least_fraction - r.fraction);
      if constexpr (Y == Yielding::von_mises) {
        if (std::isfinite(mode.branch_end))
          g.add(CompositeGuard::strength_branch, s.plastic_strain / mode.branch_end - 1.0);
        if constexpr (C)
          if (intact && mode.hardening_modulus < 0.0)
            g.add(CompositeGuard::localisation, -flow_localisation(s, m, mode.hardening_modulus));
      }
    } else if (surface_acts(mode.tension, s) && !(mode.sheared < 1.0)) {
      g.add(CompositeGuard::yield, yield_function(s, m) / yield_scale());
    }
  }
  if constexpr (C) {
    using Plane = CompositeMode::Plane;
    const DecohesionPlane plane{s.normal};
    const PlaneTraction traction_now = intact ? PlaneTraction{} : traction(plane, s.elastic_strain, m);
    if (mode.plane == Plane::held) {
      const double N = decohesion_.effective_traction(traction_now.normal, traction_now.tangential);
      g.add(CompositeGuard::decohesion,
            (N - decohesion_.strength(s.decohesion, s.cohesive_strength)) / s.cohesive_strength);
    } else if (mode.decohering()) {
      if (mode.viscous) {
        const Softening w = softening(mode, s, m);
        g.add(CompositeGuard::opening_stops, (w.strength - w.drive.traction) / s.cohesive_strength);
      } else {
        g.add(CompositeGuard::opening_stops,
              -r.decohesion * per_size * decohesion_.opening(s.cohesive_strength) / s.effective_length);
        g.add(CompositeGuard::snap_back, 0.5 * CompositeRates::least_fraction - r.fraction);
      }
      if (!decohesion_.parameters().pressure_counts)
        g.add(CompositeGuard::normal_traction_sign,
              (mode.pulled ? -traction_now.normal : traction_now.normal) / s.cohesive_strength);
      g.add(CompositeGuard::separation, s.decohesion - 1.0);
    } else if (decohesion_.is_dust()) {
      // Nothing that happens to the point changes what it bears.
    } else if (mode.plane == Plane::open) {
      g.add(CompositeGuard::closure, -s.opening_n * per_size / s.effective_length);
    } else if (mode.plane == Plane::closed) {
      g.add(CompositeGuard::opening,
            has_faces ? traction_now.normal * per_size / elastic_.p_wave() : t * per_size);
      if (mode.rubs())
        g.add(CompositeGuard::stick, -mode.slides * r.opening_t * per_size / s.effective_length);
      else if (const double friction = decohesion_.friction(); friction > 0.0)
        g.add(CompositeGuard::slip, (std::abs(traction_now.tangential) + friction * traction_now.normal) *
                                        per_size / elastic_.p_wave());
    }
  }
}

}  // namespace vitrum
