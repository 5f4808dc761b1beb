#pragma once
#include "materials/composite.hpp"

namespace vitrum {

template <bool D, Yielding Y, bool C>
Composite<D, Y, C>::Composite(const MaterialParameters& parameters, double cell)
    : parameters_(parameters), elastic_(elastic_moduli(parameters.elastic)), cell_(cell) {
  if constexpr (D) damage_ = DamageLaw(*parameters.damage, parameters.elastic);
  if constexpr (Y == Yielding::von_mises) von_mises_ = VonMisesLaw(*parameters.von_mises);
  if constexpr (Y == Yielding::drucker_prager) drucker_prager_ = DruckerPragerLaw(*parameters.drucker_prager);
  if constexpr (C) decohesion_ = DecohesionLaw(*parameters.decohesion);
  for_own_variables(
      [this](Variable v) { variables_.push_back(all_variables()[static_cast<std::size_t>(v)]); });
}

template <bool D, Yielding Y, bool C>
PointState Composite<D, Y, C>::initial_state(const SymmetricTensor& stress) const {
  PointState s;
  s.stress = stress;
  s.elastic_strain = elastic_.strain(stress);
  return s;
}

template <bool D, Yielding Y, bool C>
double Composite<D, Y, C>::damage([[maybe_unused]] const PointState& s) const {
  if constexpr (D)
    return s.crack_density > 0.0 ? damage_.damage(s.crack_density / crack_density_limit) : 0.0;
  else
    return 0.0;
}

template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::stress(const std::array<const double*, 4>& strain,
                                [[maybe_unused]] const double* crack_density, std::size_t size,
                                const std::array<double*, 4>& stress) const {
  const auto [e0, e1, e2, e3] = strain;
  const auto [s0, s1, s2, s3] = stress;
  const double* density = D ? crack_density : e0;
#pragma GCC ivdep
  for (std::size_t k = 0; k < size; ++k) {
    const SymmetricTensor e{e0[k], e1[k], e2[k], e3[k]};
    const SymmetricTensor s = secant_without_branches(trace(e), density[k]).stress(e);
    s0[k] = s.rr, s1[k] = s.zz, s2[k] = s.tt, s3[k] = s.rz;
  }
}

template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::respond(PointState& s, const SymmetricTensor& strain, double duration,
                                 PointReport& report) const {
  if constexpr (elastic_only) {
    s.elastic_strain += strain;
    s.stress = elastic_.stress(s.elastic_strain);
  } else {
    const double before = report.dissipation.total();
    double done = 0.0;
    if (!C || !is_localised(s)) done = advance_intact(s, strain, duration, report);
    if constexpr (C)
      if (is_localised(s) && done < 1.0)
        advance_localised(s, (1.0 - done) * strain, (1.0 - done) * duration, done, report);
    s.stress = secant_moduli(s).stress(s.elastic_strain);
    s.dissipated += report.dissipation.total() - before;
  }
}

/// Marks those of the particles [begin, end), at most elastic_run of them, whose increments meet an event or
/// change an internal variable (1, else 0), and tells whether there are any: most increments do not, and need
/// nothing but Hooke's law. Written to be vectorised, which the portable build can do with numbers, not with
/// truth values.
template <bool D, Yielding Y, bool C>
bool Composite<D, Y, C>::mark_inelastic(const ParticleColumns& p, std::size_t begin, std::size_t end,
                                        double duration, Marks& marks) const {
  const auto variable = [&](Variable v) { return p.start_variables[static_cast<std::size_t>(v)] + begin; };
  const double *a0 = p.start_strain[0] + begin, *a1 = p.start_strain[1] + begin,
               *a2 = p.start_strain[2] + begin, *a3 = p.start_strain[3] + begin;
  const double *d0 = p.strain_increment[0] + begin, *d1 = p.strain_increment[1] + begin,
               *d2 = p.strain_increment[2] + begin, *d3 = p.strain_increment[3] + begin;
  const double* density = D ? variable(Variable::crack_density) : a0;
  const double* max_rate = D ? variable(Variable::max_rate) : a0;
  const double* plastic_strain = has_yield ? variable(Variable::plastic_strain) : a0;
  const double* effective_length = C ? variable(Variable::effective_length) : a0;
  const std::size_t size = end - begin;
  double mean[elastic_run],
      power[elastic_run];  // strain where damage may grow, otherwise 0; its m-th power
#pragma GCC ivdep
  for (std::size_t k = 0; k < size; ++k) {
    const SymmetricTensor e0{a0[k], a1[k], a2[k], a3[k]},
        e1{a0[k] + d0[k], a1[k] + d1[k], a2[k] + d2[k], a3[k] + d3[k]};
    const double t0 = trace(e0), t1 = trace(e1);
    const double tension = std::max(t0 > 0.0 ? 1.0 : 0.0, t1 > 0.0 ? 1.0 : 0.0),
                 pressure = std::max(t0 < 0.0 ? 1.0 : 0.0, t1 < 0.0 ? 1.0 : 0.0);
    double mark = 0.0;
    if constexpr (C) mark = effective_length[k] > 0.0 ? 1.0 : 0.0;
    if constexpr (D || Y == Yielding::drucker_prager) mark = std::max(mark, tension * pressure);
    if constexpr (D) {
      const double grows = t1 > t0 ? tension : 0.0;
      mark = std::max(mark, t1 - t0 > 3.0 * duration * max_rate[k] ? grows : 0.0);
      mean[k] = grows > 0.0 ? t1 / 3.0 : 0.0;
      power[k] = 1.0;
    }
    if constexpr (has_yield) {
      const Moduli moduli = secant_without_branches(tension, density[k]);
      if constexpr (Y == Yielding::von_mises)
        mark = von_mises_.yield_function(e1, moduli, plastic_strain[k]) <= 0.0 ? mark : 1.0;
      else
        mark = drucker_prager_.yield_function(e1, moduli) <= 0.0 ? mark : std::max(mark, 1.0 - tension);
    }
    marks[k] = mark;
  }
  if constexpr (D) {
    const DamageLaw law = damage_;  // (which no store can change)
    law.raise(mean, power, size);
#pragma GCC ivdep
    for (std::size_t k = 0; k < size; ++k) {
      const double rate = law.effective_rate(max_rate[k]),
                   target = std::min(law.coefficient(rate) * power[k], crack_density_limit);
      marks[k] = target > density[k] ? 1.0 : marks[k];
    }
  }
  double any = 0.0;
#pragma omp simd reduction(max : any)
  for (std::size_t k = 0; k < size; ++k) any = std::max(any, marks[k]);
  return any > 0.0;
}

/// Whether one increment stays elastic.
template <bool D, Yielding Y, bool C>
bool Composite<D, Y, C>::stays_elastic(const PointState& s, const SymmetricTensor& strain,
                                       double duration) const {
  ParticleColumns one;
  const SymmetricTensor& e = s.elastic_strain;
  one.start_strain = {&e.rr, &e.zz, &e.tt, &e.rz};
  one.strain_increment = {&strain.rr, &strain.zz, &strain.tt, &strain.rz};
  for (std::size_t v = 0; v < variable_count; ++v) one.start_variables[v] = &(s.*variable_members[v]);
  Marks marks;
  return !mark_inelastic(one, 0, 1, duration, marks);
}

template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::load(const ParticleColumns& p, std::size_t i, PointState& s) const {
  s.elastic_strain = {p.start_strain[0][i], p.start_strain[1][i], p.start_strain[2][i], p.start_strain[3][i]};
  for_own_variables([&](Variable v) {
    const auto k = static_cast<std::size_t>(v);
    s.*variable_members[k] = p.start_variables[k][i];
  });
}

template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::store_variables(const PointState& s, const ParticleColumns& p, std::size_t i) const {
  for_own_variables([&](Variable v) {
    const auto k = static_cast<std::size_t>(v);
    if (p.variables[k] != nullptr) p.variables[k][i] = s.*variable_members[k];
  });
}

/// Increments that stay elastic of particles [begin, end), at most elastic_run of them: Hooke's law and the
/// rotation by the spin. Returns the energy they store, J. Written to be vectorised: most particles of most
/// steps pass here.
template <bool D, Yielding Y, bool C>
template <bool small>
double Composite<D, Y, C>::take_elastic_turning(const ParticleColumns& p, std::size_t begin,
                                                std::size_t end) const {
  const double *a0 = p.start_strain[0], *a1 = p.start_strain[1], *a2 = p.start_strain[2],
               *a3 = p.start_strain[3];
  const double *d0 = p.strain_increment[0], *d1 = p.strain_increment[1], *d2 = p.strain_increment[2],
               *d3 = p.strain_increment[3], *spin = p.spin_increment, *mass = p.mass;
  const double* density = D ? p.start_variables[static_cast<std::size_t>(Variable::crack_density)] : mass;
  double *e0 = p.elastic_strain[0], *e1 = p.elastic_strain[1], *e2 = p.elastic_strain[2],
         *e3 = p.elastic_strain[3];
  const double specific_volume = 1.0 / parameters_.elastic.density;
  double energies[elastic_run];  // summed apart: a sum in the loop would have to keep its order
#pragma GCC ivdep
  for (std::size_t i = begin; i < end; ++i) {
    const SymmetricTensor e = rotate({a0[i] + d0[i], a1[i] + d1[i], a2[i] + d2[i], a3[i] + d3[i]},
                                     small ? rotation_by_small(spin[i]) : rotation_by(spin[i]));
    const Moduli moduli = secant_without_branches(trace(e), density[i]);
    e0[i] = e.rr, e1[i] = e.zz, e2[i] = e.tt, e3[i] = e.rz;
    energies[i - begin] = mass[i] * specific_volume * moduli.energy(e);
  }
  double stored = 0.0;
#pragma omp simd reduction(+ : stored)
  for (std::size_t k = 0; k < end - begin; ++k) stored += energies[k];
  return stored;
}

/// Stress at the end of increments that stayed elastic.
template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::store_elastic_stress(const ParticleColumns& p, std::size_t begin,
                                              std::size_t end) const {
  std::array<const double*, 4> strain{};
  std::array<double*, 4> to{};
  for (std::size_t c = 0; c < 4; ++c) strain[c] = p.elastic_strain[c] + begin, to[c] = p.stress[c] + begin;
  const double* density = nullptr;
  if constexpr (D) density = p.start_variables[static_cast<std::size_t>(Variable::crack_density)] + begin;
  stress(strain, density, end - begin, to);
}

template <bool D, Yielding Y, bool C>
double Composite<D, Y, C>::take_elastic(const ParticleColumns& p, std::size_t begin, std::size_t end) const {
  const double* spin = p.spin_increment;
  double stored = 0.0;
  for (std::size_t first = begin; first < end; first += elastic_run) {
    const std::size_t last = std::min(end, first + elastic_run);
    double largest = 0.0;
#pragma omp simd reduction(max : largest)
    for (std::size_t i = first; i < last; ++i) largest = std::max(largest, std::abs(spin[i]));
    stored += largest <= small_angle ? take_elastic_turning<true>(p, first, last)
                                     : take_elastic_turning<false>(p, first, last);
    if (p.stress[0] != nullptr) store_elastic_stress(p, first, last);
  }
  return stored;
}

/// An increment that meets events or flows. Returns the energy stored at its end, J.
template <bool D, Yielding Y, bool C>
double Composite<D, Y, C>::take_inelastic(const ParticleColumns& p, std::size_t i, PointState& s,
                                          double duration, PointIntegrator* integrator, PointReport& point,
                                          BatchReport& report) const {
  const SymmetricTensor strain{p.strain_increment[0][i], p.strain_increment[1][i], p.strain_increment[2][i],
                               p.strain_increment[3][i]};
  point.clear();
  if (integrator == nullptr) {
    respond(s, strain, duration, point);
  } else {
    integrator->integrate(*this, s, strain, duration, point);
    report.solver += point.solver;
    if (point.failed()) {
      report.failed = i, report.failed_increment = strain, report.cause = point.cause;
      return 0.0;
    }
  }
  const Rotation turn = rotation_by(p.spin_increment[i]);
  s.elastic_strain = rotate(s.elastic_strain, turn);
  if (C && is_localised(s)) {
    const double r = s.normal_r, z = s.normal_z;
    s.normal_r = turn.cosine * r - turn.sine * z;
    s.normal_z = turn.sine * r + turn.cosine * z;
  }
  store_variables(s, p, i);
  const double reference = p.mass[i] / parameters_.elastic.density;
  report.dissipated.plastic += reference * point.dissipation.plastic;
  report.dissipated.damage += reference * point.dissipation.damage;
  report.dissipated.fracture += reference * point.dissipation.fracture;
  report.dissipated.snap_back += reference * point.dissipation.snap_back;
  for (std::size_t k = 0; k < point.event_count; ++k) report.events.push_back({i, point.events[k]});
  const SymmetricTensor& e = s.elastic_strain;
  const Moduli moduli = secant_moduli(s);
  p.elastic_strain[0][i] = e.rr, p.elastic_strain[1][i] = e.zz, p.elastic_strain[2][i] = e.tt,
  p.elastic_strain[3][i] = e.rz;
  if (p.stress[0] != nullptr) {
    const SymmetricTensor stress = moduli.stress(e);
    p.stress[0][i] = stress.rr, p.stress[1][i] = stress.zz, p.stress[2][i] = stress.tt,
    p.stress[3][i] = stress.rz;
  }
  return reference * moduli.energy(e);
}

template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::respond(const ParticleColumns& p, std::size_t begin, std::size_t end,
                                 double duration, PointIntegrator* integrator, BatchReport& report) const {
  if constexpr (elastic_only) {
    report.elastic += take_elastic(p, begin, end);
    return;
  }
  // Runs of elastic increments between the others.
  double stored = 0.0;
  std::size_t elastic_from = begin;
  PointState s;
  PointReport point;
  Marks inelastic;
  for (std::size_t first = begin; first < end; first += elastic_run) {
    const std::size_t last = std::min(end, first + elastic_run);
    if (!mark_inelastic(p, first, last, duration, inelastic)) continue;
    for (std::size_t i = first; i < last; ++i) {
      if (inelastic[i - first] == 0.0) continue;
      load(p, i, s);
      stored += take_elastic(p, elastic_from, i);
      stored += take_inelastic(p, i, s, duration, integrator, point, report);
      if (report.failed) return;  // the step fails, whatever comes after
      elastic_from = i + 1;
    }
  }
  stored += take_elastic(p, elastic_from, end);
  report.elastic += stored;
}

}  // namespace vitrum
