#pragma once
#include "materials/batch.hpp"

// Increments of many points: runs of elastic ones, and the others between them.

namespace vitrum {

/// Increments that stay elastic of particles [begin, end), at most elastic_run of them: the elastic law and
/// the rotation by the spin. Returns the energy they store, J. Written to be vectorised: most particles of
/// most steps pass here.
template <class Law>
template <bool small>
double Batch<Law>::take_elastic_turning(const ParticleColumns& p, std::size_t begin, std::size_t end) const {
  const double *a0 = p.start_strain[0], *a1 = p.start_strain[1], *a2 = p.start_strain[2],
               *a3 = p.start_strain[3];
  const double *d0 = p.strain_increment[0], *d1 = p.strain_increment[1], *d2 = p.strain_increment[2],
               *d3 = p.strain_increment[3], *spin = p.spin_increment, *mass = p.mass;
  const double* variable = mass;  // any, where none is read
  if constexpr (Law::elastic_column >= 0) variable = p.start_variables[Law::elastic_column];
  double *e0 = p.elastic_strain[0], *e1 = p.elastic_strain[1], *e2 = p.elastic_strain[2],
         *e3 = p.elastic_strain[3];
  const double specific_volume = 1.0 / density();
  double energies[elastic_run];  // summed apart: a sum in the loop would have to keep its order
#pragma GCC ivdep
  for (std::size_t i = begin; i < end; ++i) {
    const SymmetricTensor e = rotate({a0[i] + d0[i], a1[i] + d1[i], a2[i] + d2[i], a3[i] + d3[i]},
                                     small ? rotation_by_small(spin[i]) : rotation_by(spin[i]));
    const double stored = law_.elastic_energy(e, variable[i]);
    e0[i] = e.rr, e1[i] = e.zz, e2[i] = e.tt, e3[i] = e.rz;
    energies[i - begin] = mass[i] * specific_volume * stored;
  }
  double stored = 0.0;
#pragma omp simd reduction(+ : stored)
  for (std::size_t k = 0; k < end - begin; ++k) stored += energies[k];
  return stored;
}

/// Stress at the end of increments that stayed elastic.
template <class Law>
void Batch<Law>::store_elastic_stress(const ParticleColumns& p, std::size_t begin, std::size_t end) const {
  TensorPointers<const double> strain{};
  TensorPointers<double> to{};
  for (std::size_t c = 0; c < 4; ++c) strain[c] = p.elastic_strain[c] + begin, to[c] = p.stress[c] + begin;
  VariableColumns<const double*> variables = p.start_variables;
  for (const double*& column : variables) column += begin;
  stress(strain, variables, end - begin, to);
}

template <class Law>
double Batch<Law>::take_elastic(const ParticleColumns& p, std::size_t begin, std::size_t end) const {
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

/// An increment that is more than elastic. Returns the energy stored at its end, J.
template <class Law>
double Batch<Law>::take_inelastic(const ParticleColumns& p, std::size_t i, Room& room, double duration,
                                  PointIntegrator* integrator, BatchReport& report) const {
  auto& [s, state, point] = room;
  const SymmetricTensor strain = tensor_at(p.strain_increment, i);
  point.clear();
  if (integrator == nullptr) {
    load(p, i, s);
    advance(s, strain, duration, point);
  } else {
    load(p, i, state);
    integrator->integrate(*this, state, strain, duration, point);
    report.solver += point.solver;
    if (!point.failed()) s = load(state);
  }
  if (point.failed()) {
    report.failed = i, report.failed_increment = strain, report.cause = point.cause;
    return 0.0;
  }
  const Rotation by = rotation_by(p.spin_increment[i]);
  s.elastic_strain = rotate(s.elastic_strain, by);
  law_.members(s, [&](auto& member) VITRUM_INLINE_LAMBDA { turn(member, by); });
  store_variables(s, p, i);
  const double volume = p.mass[i] / density();
  report.dissipated.plastic += volume * point.dissipation.plastic;
  report.dissipated.damage += volume * point.dissipation.damage;
  report.dissipated.fracture += volume * point.dissipation.fracture;
  report.dissipated.snap_back += volume * point.dissipation.snap_back;
  for (const Event& event : point.events) report.events.push_back({i, event});
  put_tensor(p.elastic_strain, i, s.elastic_strain);
  if (p.stress[0] != nullptr) put_tensor(p.stress, i, law_.stress(s));
  return volume * law_.stored_energy(s);
}

template <class Law>
void Batch<Law>::advance(const ParticleColumns& p, std::size_t begin, std::size_t end, double duration,
                         PointIntegrator* integrator, BatchReport& report) const {
  if constexpr (runs && !dissipative) {
    report.elastic += take_elastic(p, begin, end);
    return;
  }
  double stored = 0.0;
  Room room;
  if constexpr (runs) {
    // Runs of elastic increments between the others.
    std::size_t elastic_from = begin;
    InelasticMarks inelastic;
    for (std::size_t first = begin; first < end; first += elastic_run) {
      const std::size_t last = std::min(end, first + elastic_run);
      if (!law_.mark_inelastic(p, first, last, duration, inelastic)) continue;
      for (std::size_t i = first; i < last; ++i) {
        if (inelastic[i - first] == 0.0) continue;
        stored += take_elastic(p, elastic_from, i);
        stored += take_inelastic(p, i, room, duration, integrator, report);
        if (report.failed) return;  // the step fails, whatever comes after
        elastic_from = i + 1;
      }
    }
    stored += take_elastic(p, elastic_from, end);
  } else {
    for (std::size_t i = begin; i < end; ++i) {
      stored += take_inelastic(p, i, room, duration, integrator, report);
      if (report.failed) return;
    }
  }
  report.elastic += stored;
}

template <class Law>
void Batch<Law>::stress(const TensorPointers<const double>& strain,
                        const VariableColumns<const double*>& variables, std::size_t size,
                        const TensorPointers<double>& stress) const {
  if constexpr (runs) {
    if (stress_columns().size() > 1) return stress_of_each(strain, variables, size, stress);
    const auto [e0, e1, e2, e3] = strain;
    const auto [s0, s1, s2, s3] = stress;
    const double* variable = e0;  // any, where none is read
    if constexpr (Law::elastic_column >= 0) variable = variables[Law::elastic_column];
#pragma GCC ivdep
    for (std::size_t k = 0; k < size; ++k) {
      const SymmetricTensor s = law_.elastic_stress({e0[k], e1[k], e2[k], e3[k]}, variable[k]);
      s0[k] = s.rr, s1[k] = s.zz, s2[k] = s.tt, s3[k] = s.rz;
    }
  } else {
    stress_of_each(strain, variables, size, stress);
  }
}

/// The same, where the stress depends on more than one variable.
template <class Law>
void Batch<Law>::stress_of_each(const TensorPointers<const double>& strain,
                                const VariableColumns<const double*>& variables, std::size_t size,
                                const TensorPointers<double>& stress) const {
  PointState point;
  for (std::size_t k = 0; k < size; ++k) {
    point.elastic_strain = tensor_at(strain, k);
    for (const std::size_t c : stress_columns()) point.variables[c] = variables[c][k];
    put_tensor(stress, k, law_.stress(load(point)));
  }
}

}  // namespace vitrum
