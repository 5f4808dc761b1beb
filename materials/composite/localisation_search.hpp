#pragma once
#include "materials/composite/closed_form.hpp"
#include "materials/interval.hpp"

// The first critical state of a leg, wherever in it.

namespace vitrum {

/// Whether the state admits a discontinuity: growing damage (Phi) or softening flow (H >= H_cr, eq. 25).
template <bool D, Yielding Y, bool C>
bool CompositeClosedForm<D, Y, C>::is_critical([[maybe_unused]] const Leg& leg,
                                               [[maybe_unused]] const CompositeState& s) const {
  if constexpr (C && D)
    if (leg.tension && s.crack_density > leg.start.crack_density && damage_localisation(s) <= 0.0)
      return true;
  if constexpr (C && Y == Yielding::von_mises) {
    const double modulus = von_mises_.modulus(s.plastic_strain);
    if (s.plastic_strain > leg.start.plastic_strain && modulus < 0.0)
      return flow_localisation(s, secant(leg.tension, s), modulus) <= 0.0;
  }
  return false;
}

/// Whether a state between two of a leg may be critical: a bound on both criteria.
///
/// Damage. Phi of the intervals in which crack density, trace and normal strain stay. The first two rise
/// while damage grows; the largest normal strain is convex along a straight path, and changes by no more than
/// the strain does.
///
/// Flow. The criterion is a function of c^2/r^2, centre and radius of the deviator's circle in the plane, in
/// which the normals in the plane lose and the hoop normal gains; it falls with damage. Between two of
/// `turning_points` that ratio rises or falls throughout.
template <bool D, Yielding Y, bool C>
bool CompositeClosedForm<D, Y, C>::may_localise([[maybe_unused]] const Leg& leg,
                                                [[maybe_unused]] const CompositeState& from,
                                                [[maybe_unused]] const CompositeState& to) const {
  if constexpr (C && D) {
    const SymmetricTensor &a = from.elastic_strain, &b = to.elastic_strain;
    const bool compressed = !decohesion_.parameters().partial_compression && stays_compressed(from, to);
    if (leg.tension && to.crack_density > leg.start.crack_density && trace(b) > 0.0 && !compressed) {
      if (!(trace(a) > 0.0)) return true;
      const double at_a = largest_normal_strain(a), at_b = largest_normal_strain(b);
      const Interval x{from.crack_density / crack_density_limit, to.crack_density / crack_density_limit},
          stretch{trace(a), trace(b)}, normal{0.5 * (at_a + at_b - norm(b - a)), std::max(at_a, at_b)};
      if (damage_.bifurcation(x, stretch, normal).low <= 0.0) return true;
    }
  }
  if constexpr (C && Y == Yielding::von_mises) {
    const double softest = std::max(from.plastic_strain, von_mises_.peak_strain()),
                 modulus = von_mises_.modulus(softest);
    if (to.plastic_strain > leg.start.plastic_strain && to.plastic_strain >= softest && modulus < 0.0) {
      const Moduli m = secant(leg.tension, to);
      return flow_localisation(from, m, modulus) <= 0.0 || flow_localisation(to, m, modulus) <= 0.0;
    }
  }
  return false;
}

/// Fractions of a leg at which c^2/r^2 of its deviator is stationary, in rising order within (0, end); `end`
/// where there are none.
template <bool D, Yielding Y, bool C>
std::array<double, 2> CompositeClosedForm<D, Y, C>::turning_points([[maybe_unused]] const Leg& leg,
                                                                   double end) const {
  std::array<double, 2> at{end, end};
  if constexpr (C && Y == Yielding::von_mises) {
    // c = c0 + c1 f, r^2 = A + 2 B f + C f^2: c = 0, and c1 r^2 = c (r^2)'/2, which is linear.
    const SymmetricTensor e = deviator(leg.start.elastic_strain), d = deviator(leg.strain);
    const auto half = [](const SymmetricTensor& a) { return 0.5 * (a.rr - a.zz); };
    const double c0 = 0.5 * (e.rr + e.zz), c1 = 0.5 * (d.rr + d.zz);
    const double r00 = half(e) * half(e) + e.rz * e.rz, r01 = half(e) * half(d) + e.rz * d.rz,
                 r11 = half(d) * half(d) + d.rz * d.rz;
    const auto inside = [&](double f) { return f > 0.0 && f < end ? f : end; };
    at = {inside(-c0 / c1), inside((c0 * r01 - c1 * r00) / (c1 * r01 - c0 * r11))};
    if (at[0] > at[1]) std::swap(at[0], at[1]);
  }
  return at;
}

/// Looks for the first localisation of the leg; when there is one, shortens `end` to it and sets the state
/// there.
template <bool D, Yielding Y, bool C>
bool CompositeClosedForm<D, Y, C>::find_localisation(const Leg& leg, double& end, Followed& at_end) const {
  const bool grows = at_end.state.crack_density > leg.start.crack_density;
  bool softens = false;
  if constexpr (Y == Yielding::von_mises)
    softens = at_end.state.plastic_strain > leg.start.plastic_strain &&
              at_end.state.plastic_strain >= von_mises_.peak_strain() &&
              leg.start.plastic_strain < von_mises_.floor_strain();
  if (!grows && !softens) return false;
  // Flow bends the path along which damage grows: the bound takes short pieces of it for straight.
  constexpr double growth_of_piece = 0.02, flow_of_piece = 1.0e-3, most_pieces = 128.0;
  int pieces = 1;
  if constexpr (D && Y == Yielding::von_mises) {
    const double growth = (at_end.state.crack_density - leg.start.crack_density) / crack_density_limit,
                 flowed = at_end.state.plastic_strain - leg.start.plastic_strain;
    if (grows && flowed > 0.0)
      pieces =
          static_cast<int>(std::min(1.0 + growth / growth_of_piece + flowed / flow_of_piece, most_pieces));
  }
  const std::array<double, 2> turns = turning_points(leg, end);
  Place from{0.0, leg.start};
  for (const double cut : {turns[0], turns[1], end}) {
    const double start = from.fraction, length = cut - start;
    for (int i = 1; i <= pieces && length > 0.0; ++i) {
      const double f = i < pieces ? start + length * i / pieces : cut;
      const Place to{f, f < end ? state_along(leg, f).state : at_end.state};
      constexpr int halvings = 20;  // what is critical for less than a millionth of a leg may be missed
      if (find_critical(leg, from, to, halvings, end)) {
        at_end = state_along(leg, end);
        return true;
      }
      from = to;
    }
  }
  return false;
}

/// The first critical fraction between two places of a leg, by halving what may hold one.
template <bool D, Yielding Y, bool C>
bool CompositeClosedForm<D, Y, C>::find_critical(const Leg& leg, const Place& from, const Place& to,
                                                 int halvings, double& first) const {
  if (!may_localise(leg, from.state, to.state)) return false;
  if (halvings == 0) {
    if (!is_critical(leg, to.state)) return false;
    first = first_reached(from.fraction, to.fraction,
                          [&](double f) { return is_critical(leg, state_along(leg, f).state); });
    return true;
  }
  const double f = 0.5 * (from.fraction + to.fraction);
  const Place middle{f, state_along(leg, f).state};
  return find_critical(leg, from, middle, halvings - 1, first) ||
         find_critical(leg, middle, to, halvings - 1, first);
}

}  // namespace vitrum
