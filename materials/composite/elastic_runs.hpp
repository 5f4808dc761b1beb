#pragma once
#include "materials/composite/closed_form.hpp"

// Which increments stay elastic.

namespace vitrum {

/// Marks those of the particles [begin, end), at most elastic_run of them, whose increments meet an event or
/// change an internal variable (1, else 0), and tells whether there are any: most increments do not, and need
/// nothing but Hooke's law. Written to be vectorised, which the portable build can do with numbers, not with
/// truth values.
template <bool D, Yielding Y, bool C>
bool CompositeClosedForm<D, Y, C>::mark_inelastic(const ParticleColumns& p, std::size_t begin,
                                                  std::size_t end, double duration,
                                                  InelasticMarks& marks) const {
  [[maybe_unused]] const auto variable = [&](std::size_t column) {
    return p.start_variables[column] + begin;
  };
  const double *a0 = p.start_strain[0] + begin, *a1 = p.start_strain[1] + begin,
               *a2 = p.start_strain[2] + begin, *a3 = p.start_strain[3] + begin;
  const double *d0 = p.strain_increment[0] + begin, *d1 = p.strain_increment[1] + begin,
               *d2 = p.strain_increment[2] + begin, *d3 = p.strain_increment[3] + begin;
  const double* density = D ? variable(Column::crack_density) : a0;
  const double* max_rate = D ? variable(Column::max_rate) : a0;
  const double* plastic_strain = has_yield ? variable(Column::plastic_strain) : a0;
  const double* effective_length = C ? variable(Column::effective_length) : a0;
  const std::size_t size = end - begin;
  [[maybe_unused]] const DamageLaw law = damage_;  // (which no store can change)
  double strain[elastic_run],
      power[elastic_run];  // eps_v where damage may grow, otherwise 0; its m-th power
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
      mark = std::max(mark, t1 - t0 > law.trace_of(duration) * max_rate[k] ? grows : 0.0);
      strain[k] = grows > 0.0 ? law.strain_of(t1) : 0.0;
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
    if (law.scatter()) {
      const double* strength_factor = variable(p.start_variables.size() - 2);  // before `dissipated`
#pragma GCC ivdep
      for (std::size_t k = 0; k < size; ++k) strain[k] /= strength_factor[k];
    }
    law.raise(strain, power, size);
#pragma GCC ivdep
    for (std::size_t k = 0; k < size; ++k) {
      const double rate = law.effective_rate(max_rate[k]),
                   target = std::min(law.coefficient(rate) * power[k], crack_density_limit);
      marks[k] = target > density[k] ? 1.0 : marks[k];
    }
    mark_by_rate(p, begin, end, duration, marks);
  }
  double any = 0.0;
#pragma omp simd reduction(max : any)
  for (std::size_t k = 0; k < size; ++k) any = std::max(any, marks[k]);
  return any > 0.0;
}

/// Marks besides those whose rate has to be noted, where it is not only a new maximum under tension.
template <bool D, Yielding Y, bool C>
void CompositeClosedForm<D, Y, C>::mark_by_rate(const ParticleColumns& p, std::size_t begin, std::size_t end,
                                                double duration, InelasticMarks& marks) const {
  const DamageRate rate = damage_.rate();
  if (rate == DamageRate::running_maximum || rate == DamageRate::fixed) return;
  for (std::size_t i = begin; i < end; ++i) {
    const double change = p.strain_increment[0][i] + p.strain_increment[1][i] + p.strain_increment[2][i],
                 trace = p.start_strain[0][i] + p.start_strain[1][i] + p.start_strain[2][i];
    const bool noted =
        rate == DamageRate::current ? change > 0.0 && trace + change > 0.0
        : rate == DamageRate::maximum_any_sign
            ? std::abs(change) > damage_.trace_of(duration) * p.start_variables[Column::max_rate][i]
            : true;
    if (noted) marks[i - begin] = 1.0;
  }
}

}  // namespace vitrum
