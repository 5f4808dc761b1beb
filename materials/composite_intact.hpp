#pragma once
#include "materials/composite.hpp"

namespace vitrum {

/// Follows the increment until it ends or the point localises; returns the fraction done.
template <bool D, Yielding Y, bool C>
double Composite<D, Y, C>::advance_intact(PointState& s, const SymmetricTensor& strain, double duration,
                                          PointReport& report) const {
  const double strain_trace = trace(strain), start_trace = trace(s.elastic_strain);
  bool tension = start_trace > 0.0 || (start_trace == 0.0 && strain_trace > 0.0);
  double done = 0.0;
  // A straight path changes side once; dilatant plastic flow may push it back, a bounded number of times.
  constexpr int most_legs = 8;
  for (int i = 0; i < most_legs; ++i) {
    if constexpr (D)
      if (tension && strain_trace > 0.0 && duration > 0.0)
        s.max_rate = std::max(s.max_rate, strain_trace / (3.0 * duration));
    if constexpr (Y == Yielding::drucker_prager)
      if (!tension) release_excess_shear(s, done, report);
    Leg leg{s, (1.0 - done) * strain, tension, 0.0};
    if constexpr (D)
      if (tension) leg.coefficient = damage_.coefficient(damage_.effective_rate(s.max_rate));

    double end = i + 1 == most_legs ? 1.0 : leg_end(leg);
    Followed followed = follow(leg, end);
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
        start_decohesion(leg.tension, s.crack_density > leg.start.crack_density, s);
        report.record(EventKind::localisation, done);
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
void Composite<D, Y, C>::release_excess_shear(PointState& s, double done, PointReport& report) const {
  const Moduli moduli = secant(false, s.crack_density);
  const double excess = yield_function(s, moduli);
  if (!(excess > 1e-9 * moduli.shear * norm(deviator(s.elastic_strain)))) return;
  report.dissipation.plastic += flow(s, moduli, excess);
  report.record(EventKind::yield, done);
}

/// The state after a fraction of a leg: damage from the mean strain (secant), then the return to the yield
/// surface.
template <bool D, Yielding Y, bool C>
auto Composite<D, Y, C>::follow(const Leg& leg, double fraction) const -> Followed {
  Followed f{leg.start};
  PointState& s = f.state;
  s.elastic_strain += fraction * leg.strain;
  if constexpr (D)
    if (leg.tension)
      s.crack_density =
          std::max(s.crack_density, damage_.target(trace(s.elastic_strain) / 3.0, leg.coefficient));
  if constexpr (Y == Yielding::von_mises) {
    f.plastic_dissipation = flow(s, secant(leg.tension, s.crack_density), 0.0);
  } else if constexpr (Y == Yielding::drucker_prager) {
    if (!leg.tension) {
      const Moduli moduli = secant(false, s.crack_density);
      if (yield_function(s, moduli) > 0.0)
        f.plastic_dissipation = flow(s, moduli, yield_function(leg.start, moduli));
    }
  }
  return f;
}

/// Returns to the yield surface; gives the energy dissipated, J/m^3.
template <bool D, Yielding Y, bool C>
double Composite<D, Y, C>::flow(PointState& s, const Moduli& moduli,
                                [[maybe_unused]] double violated_before) const {
  if constexpr (Y == Yielding::von_mises) {
    const SymmetricTensor d = deviator(s.elastic_strain);
    const double trial = 2.0 * moduli.shear * norm(d);
    if (trial <= von_mises_.radius(s.plastic_strain)) return 0.0;
    const PlasticReturn result = von_mises_.flow(trial, moduli.shear, s.plastic_strain);
    const double mean = trace(s.elastic_strain) / 3.0;
    s.elastic_strain = mean * identity() + (1.0 - 2.0 * moduli.shear * result.flow / trial) * d;
    return result.dissipation;
  } else if constexpr (Y == Yielding::drucker_prager) {
    return drucker_prager_.flow(s.elastic_strain, moduli, violated_before, s.plastic_strain).dissipation;
  } else {
    return 0.0;
  }
}

/// Stress measure minus strength, Pa; > 0 outside the yield surface.
template <bool D, Yielding Y, bool C>
double Composite<D, Y, C>::yield_function(const PointState& s, const Moduli& moduli) const {
  if constexpr (Y == Yielding::von_mises)
    return von_mises_.yield_function(s.elastic_strain, moduli, s.plastic_strain);
  else if constexpr (Y == Yielding::drucker_prager)
    return drucker_prager_.yield_function(s.elastic_strain, moduli);
  else
    return -1.0;
}

/// Fraction of the leg at which the mean elastic strain changes sign; 1 where it does not.
template <bool D, Yielding Y, bool C>
double Composite<D, Y, C>::leg_end(const Leg& leg) const {
  if constexpr (!D && Y != Yielding::drucker_prager) return 1.0;  // both sides follow one law
  const double start = trace(leg.start.elastic_strain), change = trace(leg.strain);
  if (leg.tension ? start + change >= 0.0 : start + change <= 0.0) return 1.0;
  if constexpr (Y == Yielding::drucker_prager) {
    if (!leg.tension && drucker_prager_.dilatancy() > 0.0) {
      const auto tensile = [&](double f) { return trace(follow(leg, f).state.elastic_strain) > 0.0; };
      return tensile(1.0) ? first_reached(0.0, 1.0, tensile) : 1.0;
    }
  }
  return std::clamp(-start / change, 0.0, 1.0);
}

/// <= 0 where the state admits a discontinuity: growing damage (Phi) or softening flow (H >= H_cr, eq. 25).
template <bool D, Yielding Y, bool C>
double Composite<D, Y, C>::localisation_criterion([[maybe_unused]] const Leg& leg,
                                                  [[maybe_unused]] const PointState& s) const {
  double value = std::numeric_limits<double>::infinity();
  if constexpr (C && D) {
    if (leg.tension && s.crack_density > leg.start.crack_density) value = damage_localisation(s);
  }
  if constexpr (C && Y == Yielding::von_mises) {
    const double modulus = von_mises_.modulus(s.plastic_strain);
    if (s.plastic_strain > leg.start.plastic_strain && modulus < 0.0)
      value = std::min(value, flow_localisation(s, secant(leg.tension, s.crack_density), modulus));
  }
  return value;
}

/// Looks for the first localisation of the leg; when there is one, shortens `end` to it and sets the state
/// there.
template <bool D, Yielding Y, bool C>
bool Composite<D, Y, C>::find_localisation(const Leg& leg, double& end, Followed& at_end) const {
  const double growth = (at_end.state.crack_density - leg.start.crack_density) / crack_density_limit;
  const double plastic = at_end.state.plastic_strain - leg.start.plastic_strain;
  if (!(growth > 0.0) && !(plastic > 0.0)) return false;
  // Samples fine enough that the criterion cannot cross zero twice between two of them; uniform in x where
  // damage grows.
  const int samples = static_cast<int>(std::min(1.0 + growth / 0.02 + plastic / 1.0e-3, 128.0));
  const double start_trace = trace(leg.start.elastic_strain), change = trace(leg.strain);
  const auto critical = [&](double f) { return localisation_criterion(leg, follow(leg, f).state) <= 0.0; };
  double previous = 0.0;
  for (int i = 1; i <= samples; ++i) {
    double f = end * i / samples;
    if constexpr (D) {
      if (growth > 0.0 && (i < samples || at_end.state.crack_density >= crack_density_limit)) {
        const double density = leg.start.crack_density + growth * crack_density_limit * i / samples;
        f = std::clamp((3.0 * damage_.mean_strain_at(density, leg.coefficient) - start_trace) / change,
                       previous, end);
      }
    }
    if (critical(f)) {
      end = first_reached(previous, f, critical);
      at_end = follow(leg, end);
      return true;
    }
    previous = f;
  }
  return false;
}

/// Fixes plane, strength (eq. 18) and effective length from the state at localisation.
template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::start_decohesion(bool tension, [[maybe_unused]] bool damage_grows,
                                          PointState& s) const {
  const Moduli moduli = secant(tension, s.crack_density);
  const bool all = decohesion_.parameters().search_all_planes;
  double best = std::numeric_limits<double>::infinity();
  if constexpr (D) {
    if (tension && damage_grows) {
      const InPlanePrincipal p = in_plane_principal(s.elastic_strain);
      const bool hoop = all && s.elastic_strain.tt > p.major;
      const double largest = hoop ? s.elastic_strain.tt : p.major;
      best = damage_.bifurcation(s.crack_density / crack_density_limit, trace(s.elastic_strain), largest);
      s.normal_r = hoop ? 0.0 : p.direction_r;
      s.normal_z = hoop ? 0.0 : p.direction_z;
    }
  }
  if constexpr (Y == Yielding::von_mises) {
    if (von_mises_.modulus(s.plastic_strain) < 0.0) {
      const CriticalPlane plane =
          von_mises_critical_plane(2.0 * moduli.shear * deviator(s.elastic_strain), moduli,
                                   von_mises_.tangent_drop(moduli.shear, s.plastic_strain), all);
      if (1.0 - plane.severity < best) s.normal_r = plane.normal_r, s.normal_z = plane.normal_z;
    }
  }
  const DecohesionPlane plane{s.normal_r, s.normal_z};
  const PlaneTraction t = traction(plane, s.elastic_strain, moduli);
  s.cohesive_strength = decohesion_.effective_traction(t.normal, t.tangential);
  s.effective_length = plane.effective_length(cell_);
}

template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::record_events([[maybe_unused]] const Leg& leg,
                                       [[maybe_unused]] const PointState& end,
                                       [[maybe_unused]] double end_fraction, [[maybe_unused]] double done,
                                       [[maybe_unused]] PointReport& report) const {
  [[maybe_unused]] const auto of_increment = [done](double f) { return done + f * (1.0 - done); };
  if constexpr (D)
    if (leg.start.crack_density == 0.0 && end.crack_density > 0.0)
      report.record(EventKind::damage, of_increment(0.0));
  if constexpr (Y != Yielding::none) {
    if (end.plastic_strain <= leg.start.plastic_strain) return;
    const Moduli moduli = secant(leg.tension, leg.start.crack_density);
    // A start clearly inside the surface is an entry into plastic flow; on the surface, flow merely goes on.
    const bool inside =
        yield_function(leg.start, moduli) < -1e-9 * moduli.shear * norm(deviator(end.elastic_strain));
    if (inside || leg.start.plastic_strain == 0.0) {
      const auto yields = [&](double f) {
        PointState s = leg.start;
        s.elastic_strain += f * leg.strain;
        return yield_function(s, moduli) >= 0.0;
      };
      const double at = yields(0.0)            ? 0.0
                        : yields(end_fraction) ? first_reached(0.0, end_fraction, yields)
                                               : end_fraction;
      report.record(EventKind::yield, of_increment(at));
    }
  }
  if constexpr (Y == Yielding::von_mises) {
    const double peak = von_mises_.peak_strain();
    if (leg.start.plastic_strain < peak && end.plastic_strain >= peak) {
      const auto past = [&](double f) { return follow(leg, f).state.plastic_strain >= peak; };
      report.record(EventKind::peak, of_increment(first_reached(0.0, end_fraction, past)));
    }
  }
}

/// Energy set free by the growth of damage on a leg, J/m^3.
template <bool D, Yielding Y, bool C>
double Composite<D, Y, C>::damage_dissipation(const Leg& leg, const PointState& end,
                                              double end_fraction) const {
  const double start_trace = trace(leg.start.elastic_strain), change = trace(leg.strain);
  double x0 = leg.start.crack_density / crack_density_limit;
  const double x1 = end.crack_density / crack_density_limit;
  const double at_start = damage_.target(start_trace / 3.0, leg.coefficient);
  const auto fraction_at = [&](double density) {
    return std::clamp((3.0 * damage_.mean_strain_at(density, leg.coefficient) - start_trace) / change, 0.0,
                      end_fraction);
  };
  // Growth begins where eq. 7 catches up with the crack density held so far, and ends at its cap.
  const bool grows_from_start = at_start >= leg.start.crack_density * (1.0 - 1e-12);
  const double from = grows_from_start ? 0.0 : fraction_at(leg.start.crack_density);
  const double to = x1 >= 1.0 ? fraction_at(crack_density_limit) : end_fraction;
  // An initial stress may ask for more damage than the start holds: that much comes at once, at constant
  // strain.
  double sudden = 0.0;
  if (at_start > leg.start.crack_density * (1.0 + 1e-9)) {
    const double x = std::min(at_start / crack_density_limit, x1);
    sudden = damage_.moduli(x0).energy(leg.start.elastic_strain) -
             damage_.moduli(x).energy(leg.start.elastic_strain);
    x0 = x;
  }
  const auto elastic_strain_at = [&](double fraction) {
    // (Plastic flow takes part of the deviator: between both states the path is taken for straight.)
    if constexpr (Y == Yielding::von_mises)
      if (fraction > 0.0) return follow(leg, fraction).state.elastic_strain;
    return leg.start.elastic_strain + fraction * leg.strain;
  };
  return sudden + damage_.dissipation(x0, x1, elastic_strain_at(from), elastic_strain_at(to));
}

}  // namespace vitrum
