#pragma once
#include "materials/composite/composite.hpp"

// The composite as a law: what it stores, its closed-form response, and which increments stay elastic.

namespace vitrum {

template <bool D, Yielding Y, bool C>
Composite<D, Y, C>::Composite(const MaterialParameters& parameters, double cell)
    : parameters_(parameters), elastic_(elastic_moduli(parameters.elastic)), cell_(cell) {
  if constexpr (D) damage_ = DamageLaw(*parameters.damage, parameters.elastic);
  if constexpr (Y == Yielding::von_mises) von_mises_ = VonMisesLaw(*parameters.von_mises);
  if constexpr (Y == Yielding::drucker_prager) drucker_prager_ = DruckerPragerLaw(*parameters.drucker_prager);
  if constexpr (C) decohesion_ = DecohesionLaw(*parameters.decohesion);
}

template <bool D, Yielding Y, bool C>
std::vector<Variable> Composite<D, Y, C>::variables() const {
  std::vector<Variable> list;
  [[maybe_unused]] const auto add = [&list](const std::vector<Variable>& model) {
    list.insert(list.end(), model.begin(), model.end());
  };
  if constexpr (D) add(damage_variables());
  if constexpr (has_yield) add(plasticity_variables());
  if constexpr (C) add(decohesion_variables());
  return list;
}

template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::advance(CompositeState& s, const SymmetricTensor& strain,
                                 [[maybe_unused]] double duration,
                                 [[maybe_unused]] PointReport& report) const {
  if constexpr (!dissipates) {
    s.elastic_strain += strain;
  } else {
    double done = 0.0;
    if (!C || !is_localised(s)) done = advance_intact(s, strain, duration, report);
    if constexpr (C)
      if (is_localised(s) && done < 1.0)
        advance_localised(s, (1.0 - done) * strain, (1.0 - done) * duration, done, report);
  }
}

/// Marks those of the particles [begin, end), at most elastic_run of them, whose increments meet an event or
/// change an internal variable (1, else 0), and tells whether there are any: most increments do not, and need
/// nothing but Hooke's law. Written to be vectorised, which the portable build can do with numbers, not with
/// truth values.
template <bool D, Yielding Y, bool C>
bool Composite<D, Y, C>::mark_inelastic(const ParticleColumns& p, std::size_t begin, std::size_t end,
                                        double duration, InelasticMarks& marks) const {
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

}  // namespace vitrum
