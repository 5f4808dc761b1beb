#include "integrators/local/mode_problem.hpp"

#include <algorithm>
#include <cmath>

namespace vitrum {

ModeProblem::ModeProblem(const Material& material, const EvolutionMode& mode, const StrainPath& path,
                         const PointState& state, double fraction)
    : material_(material),
      mode_(mode),
      path_(path),
      start_(state),
      start_fraction_(fraction),
      parameter_end_(1.0 - fraction),
      fraction_is_unknown_(mode.may_snap_back()) {
  const MaterialParameters& p = material.parameters();
  constexpr double nothing = 1.0e-100;  // keeps the scales of a point at rest off zero
  const double change = std::max(norm(path.strain), nothing), strain = norm(state.elastic_strain) + change;
  const double energy = elastic_moduli(p.elastic).p_wave() * strain * change;  // work of the increment
  if (mode.flowing) {
    const SymmetricTensor& e = state.elastic_strain;
    add(Unknown::elastic_rr, strain, e.rr), add(Unknown::elastic_zz, strain, e.zz);
    add(Unknown::elastic_tt, strain, e.tt), add(Unknown::elastic_rz, strain, e.rz);
    add(Unknown::plastic_strain, strain, state.plastic_strain);
    add(Unknown::plastic, energy, 0.0);
  }
  if (mode.damaging) {
    add(Unknown::crack_density, crack_density_limit, state.crack_density);
    add(Unknown::damage, energy, 0.0);
  }
  if (mode.decohering()) add(Unknown::decohesion, 1.0, state.decohesion);
  if (mode.decohering() || (mode.separated() && mode.flowing)) {
    const double u0 = p.decohesion->opening;
    add(Unknown::opening_n, u0, state.opening_n), add(Unknown::opening_t, u0, state.opening_t);
  }
  if (mode.decohering()) add(Unknown::fracture, energy, 0.0);
  if (fraction_is_unknown_) {
    add(Unknown::fraction, 1.0, fraction);
    parameter_end_ = 1.0e6;  // never reached: the root `path_end` comes first
  }
}

bool ModeProblem::stiff() const {
  if (mode_.decohering() && mode_.viscous) return true;
  return mode_.flowing && norm(path_.strain) > 20.0 * norm(deviator(start_.elastic_strain));
}

void ModeProblem::initial(double* y) const {
  for (std::size_t i = 0; i < size_; ++i) y[i] = starts_[i] / scales_[i];
}

double ModeProblem::fraction(double parameter, const double* y) const {
  return fraction_is_unknown_ ? y[size_ - 1] : start_fraction_ + parameter;
}

PointState ModeProblem::state(double parameter, const double* y) const {
  PointState s = start_;
  for (std::size_t i = 0; i < size_; ++i) {
    const double value = scales_[i] * y[i];
    switch (unknowns_[i]) {
      case Unknown::elastic_rr:
        s.elastic_strain.rr = value;
        break;
      case Unknown::elastic_zz:
        s.elastic_strain.zz = value;
        break;
      case Unknown::elastic_tt:
        s.elastic_strain.tt = value;
        break;
      case Unknown::elastic_rz:
        s.elastic_strain.rz = value;
        break;
      case Unknown::plastic_strain:
        s.plastic_strain = value;
        break;
      case Unknown::crack_density:
        s.crack_density = value;
        break;
      case Unknown::decohesion:
        s.decohesion = value;
        break;
      case Unknown::opening_n:
        s.opening_n = value;
        break;
      case Unknown::opening_t:
        s.opening_t = value;
        break;
      case Unknown::plastic:
      case Unknown::damage:
      case Unknown::fracture:
      case Unknown::fraction:
        break;
    }
  }
  if (!mode_.flowing) {
    s.elastic_strain += (fraction(parameter, y) - start_fraction_) * path_.strain;
    if (mode_.decohering()) {
      const DecohesionPlane plane{s.normal_r, s.normal_z};
      s.elastic_strain -= plane.jump_strain(s.opening_n - start_.opening_n, s.opening_t - start_.opening_t,
                                            s.effective_length);
    }
  }
  return s;
}

Dissipation ModeProblem::dissipation(const double* y) const {
  Dissipation d;
  for (std::size_t i = 0; i < size_; ++i) {
    if (unknowns_[i] == Unknown::plastic) d.plastic = scales_[i] * y[i];
    if (unknowns_[i] == Unknown::damage) d.damage = scales_[i] * y[i];
    if (unknowns_[i] == Unknown::fracture) d.fracture = scales_[i] * y[i];
  }
  return d;
}

bool ModeProblem::rates(double parameter, const double* y, double* out) const {
  const EvolutionRates r = material_.rates(mode_, state(parameter, y), path_);
  const auto value = [&r](Unknown u) {
    switch (u) {
      case Unknown::elastic_rr:
        return r.elastic_strain.rr;
      case Unknown::elastic_zz:
        return r.elastic_strain.zz;
      case Unknown::elastic_tt:
        return r.elastic_strain.tt;
      case Unknown::elastic_rz:
        return r.elastic_strain.rz;
      case Unknown::plastic_strain:
        return r.plastic_strain;
      case Unknown::crack_density:
        return r.crack_density;
      case Unknown::decohesion:
        return r.decohesion;
      case Unknown::opening_n:
        return r.opening_n;
      case Unknown::opening_t:
        return r.opening_t;
      case Unknown::plastic:
        return r.plastic;
      case Unknown::damage:
        return r.damage;
      case Unknown::fracture:
        return r.fracture;
      case Unknown::fraction:
        return r.fraction;
    }
    return 0.0;
  };
  double sum = 0.0;
  for (std::size_t i = 0; i < size_; ++i) sum += out[i] = value(unknowns_[i]) / scales_[i];
  return std::isfinite(sum);
}

void ModeProblem::jacobian(double parameter, const double* y, double* columns) const {
  // Unknowns of this mode: lambda, normal and tangential opening, fracture energy.
  const OpeningJacobian J = material_.opening_jacobian(mode_, state(parameter, y), path_);
  for (std::size_t j = 0; j < size_; ++j)
    for (std::size_t i = 0; i < size_; ++i)
      columns[j * size_ + i] = j < 3 ? J[i][j] * scales_[j] / scales_[i] : 0.0;
}

void ModeProblem::events(double parameter, const double* y, EventFunctions& functions) const {
  material_.events(mode_, state(parameter, y), path_, functions);
  if (fraction_is_unknown_) functions.add(Root::path_end, fraction(parameter, y) - 1.0);
}

void ModeProblem::settle(double parameter, double* y) const {
  PointState s = state(parameter, y);
  material_.settle(mode_, s, path_);
  for (std::size_t i = 0; i < size_; ++i) {
    const auto set = [&](double value) { y[i] = value / scales_[i]; };
    switch (unknowns_[i]) {
      case Unknown::elastic_rr:
        set(s.elastic_strain.rr);
        break;
      case Unknown::elastic_zz:
        set(s.elastic_strain.zz);
        break;
      case Unknown::elastic_tt:
        set(s.elastic_strain.tt);
        break;
      case Unknown::elastic_rz:
        set(s.elastic_strain.rz);
        break;
      case Unknown::plastic_strain:
        set(s.plastic_strain);
        break;
      case Unknown::decohesion:
        set(s.decohesion);
        break;
      case Unknown::opening_n:
        set(s.opening_n);
        break;
      case Unknown::opening_t:
        set(s.opening_t);
        break;
      default:
        break;
    }
  }
}

void ModeProblem::absolute_tolerances(double relative, double absolute, double* tolerances) const {
  // Where the strength is small against the increment, a part of the increment would be all of the stress.
  constexpr double part_of_strength = 0.1;
  const double strength = part_of_strength * norm(deviator(start_.elastic_strain));
  for (std::size_t i = 0; i < size_; ++i) {
    const Unknown u = unknowns_[i];
    const bool alone = u == Unknown::plastic_strain || u == Unknown::crack_density ||
                       u == Unknown::decohesion || u == Unknown::fraction;
    tolerances[i] = alone ? absolute : absolute + relative;
    if (is_elastic_strain(u) && strength > 0.0)
      tolerances[i] = std::max(absolute, std::min(tolerances[i], strength / scales_[i]));
  }
}

const char* ModeProblem::name(std::size_t unknown) const {
  constexpr std::array<const char*, 13> names{
      "elastic strain rr",        "elastic strain zz",   "elastic strain tt",  "elastic strain rz",
      "plastic strain",           "crack density",       "decohesion",         "normal opening",
      "tangential opening",       "plastic dissipation", "damage dissipation", "fracture energy",
      "fraction of the increment"};
  return unknown < size_ ? names[static_cast<std::size_t>(unknowns_[unknown])] : "unknown";
}

}  // namespace vitrum
