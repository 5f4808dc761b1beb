#pragma once
#include "materials/composite/closed_form.hpp"

// Rubble that bears shear, over a straight path: a void that closes, and the cone q = beta P.

namespace vitrum {

/// Rubble over `strain` (`done`: fraction of the increment before). The void closes, or pressure lets go, at
/// most once.
template <bool D, Yielding Y, bool C>
void CompositeClosedForm<D, Y, C>::advance_rubble(CompositeState& s, const SymmetricTensor& strain,
                                                  double done, PointReport& report) const {
  const CompositeState before = s;
  const bool was_open = s.opening_n > 0.0;
  double changed_at = 0.0;
  s.elastic_strain += strain;
  free_faces(s);
  const bool parts = !was_open && trace(before.elastic_strain) < 0.0 && !(trace(s.elastic_strain) < 0.0);
  if (parts) {
    s = before;
    changed_at = let_rubble_go(s, strain, report.dissipation);
    s.elastic_strain = (1.0 - changed_at) * strain;
    free_faces(s);
  } else if (was_open && !(s.opening_n > 0.0)) {
    changed_at = std::clamp(-before.opening_n / (trace(strain) * s.effective_length), 0.0, 1.0);
    report.record(EventKind::closure, done + changed_at * (1.0 - done), stress(s));
    load_rubble(s, report.dissipation);
  } else if (norm(before.elastic_strain) <= tolerance::rounding * norm(strain)) {
    load_rubble(s, report.dissipation);
  }
  if (before.plastic_strain == 0.0 && s.plastic_strain > 0.0)
    report.record(EventKind::yield, done + (parts ? 0.0 : changed_at) * (1.0 - done), stress(s));
}

/// What rubble was strained from its apex, where no flow has a direction: pressure and the shear that it
/// bears grow along a straight line.
template <bool D, Yielding Y, bool C>
void CompositeClosedForm<D, Y, C>::load_rubble(CompositeState& s, Dissipation& dissipation) const {
  const double share = share_of_shear(s, s.elastic_strain);
  if (!(share < 1.0) || !(trace(s.elastic_strain) < 0.0)) return;
  const SymmetricTensor d = deviator(s.elastic_strain);
  dissipation.plastic += secant(false, s).shear * share * (1.0 - share) * contract(d, d);
  s.plastic_strain += (1.0 - share) * norm(d);
  s.elastic_strain -= (1.0 - share) * d;
}

/// Rubble from under pressure to its apex; returns the fraction of `strain` that leads there. On the cone the
/// deviator, of size r, falls with the pressure, r = r_1 u, u from 1 to 0, and turns towards that of the
/// strain, at an angle with tan(angle / 2) = a u^k, k = |dev strain| / |dr|. What is dissipated is what was
/// stored of shear and the work of shear on the way.
template <bool D, Yielding Y, bool C>
double CompositeClosedForm<D, Y, C>::let_rubble_go(CompositeState& s, const SymmetricTensor& strain,
                                                   Dissipation& dissipation) const {
  const Moduli m = secant(false, s);
  const double end = std::clamp(-trace(s.elastic_strain) / trace(strain), 0.0, 1.0);
  const SymmetricTensor d = deviator(s.elastic_strain), way = end * deviator(strain);
  // Where the cone is met: |d + f way| = bearable (1 - f), or at the apex.
  const double bearable =
      -parameters_.drucker_prager->beta * m.bulk * trace(s.elastic_strain) / (std::sqrt(6.0) * m.shear);
  const double c = std::min(0.0, contract(d, d) - bearable * bearable),
               b = contract(d, way) + bearable * bearable, a = contract(way, way) - bearable * bearable;
  const double root = std::sqrt(std::max(0.0, b * b - a * c));
  const double met = b > 0.0 ? std::min(1.0, -c / (b + root)) : a > 0.0 ? std::min(1.0, (root - b) / a) : 1.0;
  const SymmetricTensor on_cone = d + met * way, rest = (1.0 - met) * way;
  const double r = norm(on_cone), length = norm(rest);
  dissipation.plastic += m.shear * r * r;
  s.elastic_strain = {};
  if (!(r > 0.0)) return end;
  // Midpoint rule: the integrands are bounded and monotone.
  constexpr int points = 64;
  const double cosine = length > 0.0 ? contract(on_cone, rest) / (r * length) : 1.0;
  const double square = (1.0 - cosine) / std::max(1.0 + cosine, std::numeric_limits<double>::min());
  double along = 0.0, work = 0.0;  // of the rest of the strain, in the direction of the deviator
  for (int i = 0; i < points; ++i) {
    const double u = (i + 0.5) / points, w = square * std::pow(u, 2.0 * length / r);
    along += length / points * (1.0 - w) / (1.0 + w);
    work += 2.0 * m.shear * r * u * length / points * (1.0 - w) / (1.0 + w);
  }
  dissipation.plastic += work;
  s.plastic_strain += std::max(0.0, along + r);
  return end;
}

}  // namespace vitrum
