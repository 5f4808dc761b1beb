#pragma once
#include "materials/batch.hpp"

// Consistent tangents: Hooke's law where increments are elastic, else differences of the response.

namespace vitrum {

/// Whether one increment stays elastic.
template <class Law>
bool Batch<Law>::stays_elastic(const State& s, const SymmetricTensor& strain, double duration) const {
  if constexpr (!dissipative) return true;
  if constexpr (runs) {
    PointState point;
    store(s, point);
    ParticleColumns one;
    const SymmetricTensor& e = s.elastic_strain;
    one.start_strain = {&e.rr, &e.zz, &e.tt, &e.rz};
    one.strain_increment = {&strain.rr, &strain.zz, &strain.tt, &strain.rz};
    for (std::size_t k = 0; k < columns().size(); ++k) one.start_variables.push_back(&point.variables[k]);
    InelasticMarks marks;
    return !law_.mark_inelastic(one, 0, 1, duration, marks);
  }
  return false;
}

template <class Law>
TangentEntries Batch<Law>::tangent(const State& start, const SymmetricTensor& strain, double duration) const {
  if constexpr (hookean) {
    if (stays_elastic(start, strain, duration)) {
      State end = start;
      end.elastic_strain += strain;
      return elastic_entries(law_.secant_moduli(end));
    }
  }
  return tangent_by_differences(start, strain, duration);
}

template <class Law>
TangentEntries Batch<Law>::tangent_by_differences(const State& start, const SymmetricTensor& strain,
                                                  double duration) const {
  const auto end_after = [&](const SymmetricTensor& increment) {
    State s = start;
    PointReport report;
    advance(s, increment, duration, report);
    return s;
  };
  // Central differences: the average of both sides at a kink.
  const auto differences = [&](double step, double& largest) {
    TangentEntries T{};
    largest = 0.0;
    for (std::size_t column = 0; column < 4; ++column) {
      SymmetricTensor shift{};
      (column == 0 ? shift.rr : column == 1 ? shift.zz : column == 2 ? shift.tt : shift.rz) = step;
      const SymmetricTensor change =
          (0.5 / step) * (end_after(strain + shift).stress - end_after(strain - shift).stress);
      T[column] = change.rr, T[4 + column] = change.zz, T[8 + column] = change.tt, T[12 + column] = change.rz;
      const double size = norm(change);
      largest = size <= largest ? largest : size;  // keeps what is not a number
    }
    return T;
  };
  // The step is far above what rounding leaves of the stress, far below the strains over which the laws
  // change.
  constexpr double relative_step = 1e-6, least_strain = 1e-9, steadiness = 0.1;
  const double step = relative_step * std::max({norm(start.elastic_strain), norm(strain), least_strain});
  double largest = 0.0, nearer = 0.0;
  const TangentEntries T = differences(step, largest);
  if (largest <= 2.0 * law_.elastic().p_wave()) return T;
  // So steep is growing damage, which keeps its slope in a quarter of the stencil, or a jump, which does not.
  differences(0.25 * step, nearer);
  if (std::abs(nearer - largest) <= steadiness * largest) return T;
  if constexpr (hookean)
    return elastic_entries(law_.secant_moduli(end_after(strain)));
  else
    return elastic_entries(law_.elastic());
}

template <class Law>
void Batch<Law>::tangent(const ParticleColumns& p, std::size_t begin, std::size_t end, double duration,
                         TangentEntries* tangents) const {
  State s;
  InelasticMarks inelastic;
  for (std::size_t first = begin; first < end; first += elastic_run) {
    const std::size_t last = std::min(end, first + elastic_run);
    inelastic.fill(1.0);
    if constexpr (runs && hookean) {
      if constexpr (dissipative)
        law_.mark_inelastic(p, first, last, duration, inelastic);
      else
        inelastic.fill(0.0);
    }
    for (std::size_t i = first; i < last; ++i) {
      load(p, i, s);
      const SymmetricTensor strain = tensor_at(p.strain_increment, i);
      if constexpr (hookean) {
        if (inelastic[i - first] == 0.0) {
          s.elastic_strain += strain;
          tangents[i] = elastic_entries(law_.secant_moduli(s));
          continue;
        }
      }
      s.stress = law_.stress(s);
      tangents[i] = tangent_by_differences(s, strain, duration);
    }
  }
}

}  // namespace vitrum
