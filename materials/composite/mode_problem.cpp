#include "materials/composite/mode_problem.hpp"

#include <algorithm>
#include <cmath>

#include "materials/composite/damage.hpp"
#include "materials/composite/decohesion.hpp"

namespace vitrum {

template <class Of>
ModeProblem::Values ModeProblem::state_values(const Of& of) {
  const SymmetricTensor& e = of.elastic_strain;
  const double mean = trace(e) / 3.0;
  Values v{};
  v[mean_strain] = mean;
  v[deviator_rr] = e.rr - mean, v[deviator_zz] = e.zz - mean, v[deviator_rz] = e.rz;
  v[plastic_strain] = of.plastic_strain, v[crack_density] = of.crack_density, v[decohesion] = of.decohesion;
  v[opening_n] = of.opening_n, v[opening_t] = of.opening_t;
  return v;
}

ModeProblem::Values ModeProblem::rate_values(const CompositeRates& r) {
  Values v = state_values(r);
  v[plastic] = r.plastic, v[damage] = r.damage, v[fracture] = r.fracture, v[fraction_of_path] = r.fraction;
  return v;
}

ModeProblem::ModeProblem(const CompositeModes& law, const CompositeMode& mode, const StrainPath& path,
                         const CompositeState& state, double fraction)
    : law_(law),
      mode_(mode),
      path_(path),
      start_(state),
      start_fraction_(fraction),
      parameter_end_(1.0 - fraction),
      fraction_is_unknown_(mode.may_snap_back()),
      start_values_(state_values(state)) {
  constexpr double nothing = 1.0e-100;  // keeps the scales of a point at rest off zero
  const double change = std::max(norm(path.strain), nothing), strain = norm(state.elastic_strain) + change;
  const double energy = law.virgin_moduli().p_wave() * strain * change;  // work of the increment
  if (mode.flowing) {
    // Strength is a matter of the deviator (and of pressure, where that gives it): were its parts unknowns
    // together with the pressure, an error relative to them could be many times a strength that is small.
    const double distortion = norm(deviator(state.elastic_strain)) + change;
    add(mean_strain, strain), add(deviator_rr, distortion);
    add(deviator_zz, distortion), add(deviator_rz, distortion);
    add(plastic_strain, distortion);
    add(plastic, energy);
  }
  if (mode.damaging) add(crack_density, crack_density_limit), add(damage, energy);
  if (mode.decohering()) add(decohesion, 1.0);
  if (mode.decohering() || (mode.separated() && mode.flowing) || mode.rubs()) {
    const double u0 = law.reference_opening(state);
    add(opening_n, u0), add(opening_t, u0);
  }
  if (mode.rubs() && !mode.flowing) add(plastic, energy);
  if (mode.decohering()) add(fracture, energy);
  if (fraction_is_unknown_) {
    start_values_[fraction_of_path] = fraction;
    add(fraction_of_path, 1.0);
    parameter_end_ = 1.0e6;  // never reached: the root `path_end` comes first
  }
}

bool ModeProblem::stiff() const {
  if (mode_.decohering() && mode_.viscous) return true;
  return mode_.flowing && norm(path_.strain) > 20.0 * norm(deviator(start_.elastic_strain));
}

void ModeProblem::initial(double* y) const {
  for (std::size_t i = 0; i < size_; ++i) y[i] = start_values_[unknowns_[i]] / scales_[i];
}

double ModeProblem::fraction(double parameter, const double* y) const {
  return fraction_is_unknown_ ? y[size_ - 1] : start_fraction_ + parameter;
}

ModeProblem::Values ModeProblem::values(const double* y) const {
  Values v = start_values_;
  for (std::size_t i = 0; i < size_; ++i) v[unknowns_[i]] = scales_[i] * y[i];
  return v;
}

CompositeState ModeProblem::state(double parameter, const double* y) const {
  const Values v = values(y);
  CompositeState s = start_;
  s.plastic_strain = v[plastic_strain], s.crack_density = v[crack_density], s.decohesion = v[decohesion];
  s.opening_n = v[opening_n], s.opening_t = v[opening_t];
  if (mode_.flowing) {
    const double mean = v[mean_strain], rr = v[deviator_rr], zz = v[deviator_zz];
    s.elastic_strain = {mean + rr, mean + zz, mean - (rr + zz), v[deviator_rz]};
    return s;
  }
  s.elastic_strain += (fraction(parameter, y) - start_fraction_) * path_.strain;
  if (mode_.decohering() || mode_.rubs()) {
    const DecohesionPlane plane{s.normal};
    s.elastic_strain -=
        plane.jump_strain(s.opening_n - start_.opening_n, s.opening_t - start_.opening_t, s.effective_length);
  }
  return s;
}

Dissipation ModeProblem::dissipation(const double* y) const {
  const Values v = values(y);
  return {.plastic = v[plastic], .damage = v[damage], .fracture = v[fracture]};
}

bool ModeProblem::rates(double parameter, const double* y, double* out) const {
  const Values v = rate_values(law_.rates(mode_, state(parameter, y), path_));
  double sum = 0.0;
  for (std::size_t i = 0; i < size_; ++i) sum += out[i] = v[unknowns_[i]] / scales_[i];
  return std::isfinite(sum);
}

void ModeProblem::jacobian(double parameter, const double* y, double* columns) const {
  // Unknowns of this mode: lambda, normal and tangential opening, fracture energy.
  const OpeningJacobian J = law_.opening_jacobian(mode_, state(parameter, y), path_);
  for (std::size_t j = 0; j < size_; ++j)
    for (std::size_t i = 0; i < size_; ++i)
      columns[j * size_ + i] = j < 3 ? J[i][j] * scales_[j] / scales_[i] : 0.0;
}

void ModeProblem::guards(double parameter, const double* y, Guards& values) const {
  law_.guards(mode_, state(parameter, y), path_, values);
  if (fraction_is_unknown_) values.add(path_end, fraction(parameter, y) - 1.0);
}

void ModeProblem::project(double parameter, double* y) const {
  CompositeState s = state(parameter, y);
  law_.project(mode_, s, path_);
  const Values v = state_values(s);
  for (std::size_t i = 0; i < size_; ++i)
    if (is_settled(unknowns_[i])) y[i] = v[unknowns_[i]] / scales_[i];
}

void ModeProblem::absolute_tolerances(double relative, double absolute, double* tolerances) const {
  // Where the strength is small against the increment, a part of the increment would be all of the stress.
  constexpr double part_of_strength = 0.03;
  const double strength = part_of_strength * norm(deviator(start_.elastic_strain));
  const double work = 2.0 * law_.virgin_moduli().shear * norm(path_.strain) * strength;
  for (std::size_t i = 0; i < size_; ++i) {
    const Unknown u = unknowns_[i];
    tolerances[i] = is_alone(u) ? absolute : absolute + relative;
    const double most = is_deviator(u) ? strength : u == plastic ? work : 0.0;
    if (most > 0.0) tolerances[i] = std::max(absolute, std::min(tolerances[i], most / scales_[i]));
  }
}

const char* ModeProblem::name(std::size_t unknown) const {
  constexpr std::array<const char*, unknown_count> names{
      "mean elastic strain",      "elastic deviator rr", "elastic deviator zz", "elastic deviator rz",
      "plastic strain",           "crack density",       "decohesion",          "normal opening",
      "tangential opening",       "plastic dissipation", "damage dissipation",  "fracture energy",
      "fraction of the increment"};
  return unknown < size_ ? names[unknowns_[unknown]] : "unknown";
}

}  // namespace vitrum
