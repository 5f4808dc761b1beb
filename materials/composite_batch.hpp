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
  const auto needs = [](Variable v) {
    switch (v) {
      case Variable::crack_density:
      case Variable::max_rate: return D;
      case Variable::plastic_strain: return has_yield;
      case Variable::dissipated: return !elastic_only;
      default: return C;
    }
  };
  for (const VariableInfo& info : all_variables())
    if (needs(info.variable)) variables_.push_back(info);
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
void Composite<D, Y, C>::respond(PointState& s, const SymmetricTensor& strain, double duration, PointReport& report) const {
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

template <bool D, Yielding Y, bool C>
void Composite<D, Y, C>::respond(const ParticleColumns& p, std::size_t begin, std::size_t end, double duration,
                                 BatchReport& report) const {
  const double specific_volume = 1.0 / parameters_.elastic.density;
  PointReport point;
  double stored = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    PointState s;
    s.elastic_strain = {p.elastic_strain[0][i], p.elastic_strain[1][i], p.elastic_strain[2][i], p.elastic_strain[3][i]};
    if constexpr (!elastic_only)
      for (const VariableInfo& info : variables_) {
        const auto v = static_cast<std::size_t>(info.variable);
        s.*variable_members[v] = p.variables[v][i];
      }
    const SymmetricTensor strain{p.strain_increment[0][i], p.strain_increment[1][i], p.strain_increment[2][i],
                                 p.strain_increment[3][i]};
    point.event_count = 0;
    point.dissipation = {};
    respond(s, strain, duration, point);

    const Rotation turn = rotation_by(p.spin_increment[i]);
    const SymmetricTensor e = s.elastic_strain = rotate(s.elastic_strain, turn);
    const Moduli moduli = secant_moduli(s);
    const SymmetricTensor stress = moduli.stress(e);
    p.elastic_strain[0][i] = e.rr, p.elastic_strain[1][i] = e.zz, p.elastic_strain[2][i] = e.tt, p.elastic_strain[3][i] = e.rz;
    p.stress[0][i] = stress.rr, p.stress[1][i] = stress.zz, p.stress[2][i] = stress.tt, p.stress[3][i] = stress.rz;
    if constexpr (C)
      if (is_localised(s)) {
        const double r = s.normal_r, z = s.normal_z;
        s.normal_r = turn.cosine * r - turn.sine * z;
        s.normal_z = turn.sine * r + turn.cosine * z;
      }
    if constexpr (!elastic_only)
      for (const VariableInfo& info : variables_) {
        const auto v = static_cast<std::size_t>(info.variable);
        p.variables[v][i] = s.*variable_members[v];
      }

    const double reference = p.mass[i] * specific_volume;
    stored += reference * stored_energy_of_volume(moduli, e);
    if constexpr (!elastic_only) {
      const double volume = reference * (1.0 + trace(e));
      report.dissipated.plastic += volume * point.dissipation.plastic;
      report.dissipated.damage += volume * point.dissipation.damage;
      report.dissipated.fracture += volume * point.dissipation.fracture;
      report.dissipated.snap_back += volume * point.dissipation.snap_back;
      for (std::size_t k = 0; k < point.event_count; ++k) report.events.push_back({i, point.events[k]});
    }
  }
  report.elastic += stored;
}

}  // namespace vitrum
