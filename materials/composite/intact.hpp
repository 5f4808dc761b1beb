#pragma once
#include "materials/composite/closed_form.hpp"
#include "materials/interval.hpp"

// An increment before localisation, leg by leg.

namespace vitrum {

/// Follows the increment until it ends or the point localises; returns the fraction done.
template <bool D, Yielding Y, bool C>
double CompositeClosedForm<D, Y, C>::advance_intact(CompositeState& s, const SymmetricTensor& strain,
                                                    double duration, PointReport& report) const {
  const double strain_trace = trace(strain), start_trace = trace(s.elastic_strain);
  bool tension = start_trace > 0.0 || (start_trace == 0.0 && strain_trace > 0.0);
  double done = 0.0;
  if constexpr (D) damage_.begin(strain_trace, duration, s.max_rate, s.mean_rate);
  // A straight path changes side once; dilatant plastic flow may push it back, a bounded number of times.
  constexpr int most_legs = 8;
  for (int i = 0; i < most_legs; ++i) {
    if constexpr (D) {
      if (tension) damage_.grow(strain_trace, duration, s.max_rate, s.mean_rate);
      if (tension && damage_.rate() == DamageRate::current && damage_at_once(s, done, report)) return done;
    }
    if constexpr (Y == Yielding::drucker_prager)
      if (!tension) release_excess_shear(s, done, report);
    Leg leg{s, (1.0 - done) * strain, tension, 0.0};
    if constexpr (D)
      if (tension) leg.coefficient = damage_.coefficient(damage_.effective_rate(s.max_rate));

    double end = i + 1 == most_legs ? 1.0 : leg_end(leg);
    Followed followed = state_along(leg, end);
    bool localises = false;
    if constexpr (C) localises = find_localisation(leg, end, followed);

    record_events(leg, followed.state, end, done, report);
    report.dissipation.plastic += followed.plastic_dissipation;
    if constexpr (D)
      if (followed.state.crack_density > leg.start.crack_density)
        report.dissipation.damage += damage_dissipation(leg, followed.state, end);
    s = followed.state;
    done = end >= 1.0 ? 1.0 : done + end * (1.0 - done);
    if constexpr (C) {
      if (localises) {
        start_decohesion(leg.tension, s.crack_density > leg.start.crack_density, s, report.dissipation);
        report.record(EventKind::localisation, done, stress(s));
        return done;
      }
    }
    if (done >= 1.0) break;
    tension = !tension;
  }
  return 1.0;
}

/// Shear that only tension allowed (no yield there) falls to the surface at the instant at which pressure
/// begins.
template <bool D, Yielding Y, bool C>
void CompositeClosedForm<D, Y, C>::release_excess_shear(CompositeState& s, double done,
                                                        PointReport& report) const {
  const Moduli moduli = secant(false, s);
  const double excess = yield_function(s, moduli);
  if (!(excess > tolerance::on_surface * moduli.shear * norm(deviator(s.elastic_strain)))) return;
  report.dissipation.plastic += flow(s, moduli, excess);
  report.record(EventKind::yield, done, stress(s));
}

/// The state after a fraction of a leg: damage from the mean strain (secant), then the return to the yield
/// surface.
template <bool D, Yielding Y, bool C>
auto CompositeClosedForm<D, Y, C>::state_along(const Leg& leg, double fraction) const -> Followed {
  Followed f{leg.start};
  CompositeState& s = f.state;
  s.elastic_strain += fraction * leg.strain;
  if constexpr (D)
    if (leg.tension)
      s.crack_density = std::max(s.crack_density, damage_.target(damaging_strain(s), leg.coefficient));
  if constexpr (Y == Yielding::von_mises) {
    f.plastic_dissipation = flow(s, secant(leg.tension, s), 0.0);
  } else if constexpr (Y == Yielding::drucker_prager) {
    if (!leg.tension) {
      const Moduli moduli = secant(false, s);
      if (yield_function(s, moduli) > 0.0)
        f.plastic_dissipation = flow(s, moduli, yield_function(leg.start, moduli));
    }
  }
  return f;
}

/// Fraction of the leg at which the mean elastic strain changes sign; 1 where it does not.
template <bool D, Yielding Y, bool C>
double CompositeClosedForm<D, Y, C>::leg_end(const Leg& leg) const {
  if constexpr (!D && Y != Yielding::drucker_prager) return 1.0;  // both sides follow one law
  const double start = trace(leg.start.elastic_strain), change = trace(leg.strain);
  if (leg.tension ? start + change >= 0.0 : start + change <= 0.0) return 1.0;
  if constexpr (Y == Yielding::drucker_prager) {
    if (!leg.tension && drucker_prager_.dilatancy() > 0.0) {
      const auto tensile = [&](double f) { return trace(state_along(leg, f).state.elastic_strain) > 0.0; };
      return tensile(1.0) ? first_reached(0.0, 1.0, tensile) : 1.0;
    }
  }
  return std::clamp(-start / change, 0.0, 1.0);
}

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

template <bool D, Yielding Y, bool C>
void CompositeClosedForm<D, Y, C>::record_events([[maybe_unused]] const Leg& leg,
                                                 [[maybe_unused]] const CompositeState& end,
                                                 [[maybe_unused]] double end_fraction,
                                                 [[maybe_unused]] double done,
                                                 [[maybe_unused]] PointReport& report) const {
  [[maybe_unused]] const auto of_increment = [done](double f) { return done + f * (1.0 - done); };
  if constexpr (D)
    if (leg.start.crack_density == 0.0 && end.crack_density > 0.0)
      report.record(EventKind::damage, of_increment(0.0), stress(leg.start));
  if constexpr (Y != Yielding::none) {
    if (end.plastic_strain <= leg.start.plastic_strain) return;
    const Moduli moduli = secant(leg.tension, leg.start);
    // A start clearly inside the surface is an entry into plastic flow; on the surface, flow merely goes on.
    const bool inside = yield_function(leg.start, moduli) <
                        -tolerance::on_surface * moduli.shear * norm(deviator(end.elastic_strain));
    if (inside || leg.start.plastic_strain == 0.0) {
      const auto yields = [&](double f) {
        CompositeState s = leg.start;
        s.elastic_strain += f * leg.strain;
        return yield_function(s, moduli) >= 0.0;
      };
      const double at = yields(0.0)            ? 0.0
                        : yields(end_fraction) ? first_reached(0.0, end_fraction, yields)
                                               : end_fraction;
      report.record(EventKind::yield, of_increment(at), stress(state_along(leg, at).state));
    }
  }
  if constexpr (Y == Yielding::von_mises) {
    const double peak = von_mises_.peak_strain();
    if (leg.start.plastic_strain < peak && end.plastic_strain >= peak) {
      const auto past = [&](double f) { return state_along(leg, f).state.plastic_strain >= peak; };
      const double at = first_reached(0.0, end_fraction, past);
      report.record(EventKind::peak, of_increment(at), stress(state_along(leg, at).state));
    }
  }
}

/// Energy set free by the growth of damage on a leg, J/m^3.
template <bool D, Yielding Y, bool C>
double CompositeClosedForm<D, Y, C>::damage_dissipation(const Leg& leg, const CompositeState& end,
                                                        double end_fraction) const {
  const double start_trace = trace(leg.start.elastic_strain), change = trace(leg.strain);
  const double x0 = leg.start.crack_density / crack_density_limit;
  const double x1 = end.crack_density / crack_density_limit;
  const double at_start = damage_.target(damaging_strain(leg.start), leg.coefficient);
  const auto fraction_at = [&](double density) {
    const double at =
        damage_.trace_of(leg.start.strength_factor * damage_.strain_at(density, leg.coefficient));
    return std::clamp((at - start_trace) / change, 0.0, end_fraction);
  };
  // Growth begins where eq. 7 catches up with the crack density held so far, and ends at its cap.
  const bool grows_from_start = at_start >= leg.start.crack_density * (1.0 - tolerance::rounding);
  const double from = grows_from_start ? 0.0 : fraction_at(leg.start.crack_density);
  const double to = x1 >= 1.0 ? fraction_at(crack_density_limit) : end_fraction;
  const auto elastic_strain_at = [&](double fraction) {
    // (Plastic flow takes part of the deviator: between both states the path is taken for straight.)
    if constexpr (Y == Yielding::von_mises)
      if (fraction > 0.0) return state_along(leg, fraction).state.elastic_strain;
    return leg.start.elastic_strain + fraction * leg.strain;
  };
  return damage_.dissipation(x0, x1, elastic_strain_at(from), elastic_strain_at(to));
}

}  // namespace vitrum
