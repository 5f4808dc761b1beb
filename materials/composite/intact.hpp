#pragma once
#include "materials/composite/closed_form.hpp"

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
