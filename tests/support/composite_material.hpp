#pragma once
#include <array>
#include <memory>
#include <stdexcept>
#include <string_view>

#include "materials/composite/damage.hpp"
#include "materials/composite/evolution.hpp"
#include "materials/law.hpp"

namespace vitrum::test {

/// The numbers of a composite's state in the order in which a material with all models stores them.
inline std::array<double*, 12> numbers_of(CompositeState& s) {
  return {&s.crack_density,    &s.max_rate,          &s.plastic_strain, &s.decohesion,
          &s.opening_n,        &s.opening_t,         &s.normal.r,       &s.normal.z,
          &s.effective_length, &s.cohesive_strength, &s.mean_rate,      &s.strength_factor};
}
inline constexpr std::array<std::string_view, 12> number_names{
    "crack_density", "max_rate", "plastic_strain",   "decohesion",        "opening_n", "opening_t",
    "normal_r",      "normal_z", "effective_length", "cohesive_strength", "mean_rate", "strength_factor"};
/// One of them, or `dissipated`.
inline double& number(CompositeState& s, std::string_view name) {
  for (std::size_t k = 0; k < number_names.size(); ++k)
    if (number_names[k] == name) return *numbers_of(s)[k];
  if (name == "dissipated") return s.dissipated;
  throw std::logic_error("no variable has this name");
}
inline double number(const CompositeState& s, std::string_view name) {
  CompositeState copy = s;
  return number(copy, name);
}

/// A composite whose state tests read by name. All that they ask of it passes through the door.
class CompositeMaterial {
 public:
  CompositeMaterial(const MaterialParameters& parameters, double cell)
      : door_(make_material(parameters, cell)) {}

  const Material& door() const { return *door_; }
  const MaterialParameters& parameters() const { return door_->parameters(); }
  std::span<const Component> columns() const { return door_->columns(); }
  double wave_speed() const { return door_->wave_speed(); }
  CompositeState initial_state(const SymmetricTensor& stress) const { return named(door_->start(stress)); }
  void judge(CompositeState& s, PointReport& report) const {
    through(s, [&](PointState& p) { door_->judge(p, report); });
  }
  void respond(CompositeState& s, const SymmetricTensor& strain, double duration, PointReport& report) const {
    through(s, [&](PointState& p) { door_->advance(p, strain, duration, report); });
  }
  void respond(const ParticleColumns& particles, std::size_t begin, std::size_t end, double duration,
               PointIntegrator* integrator, BatchReport& report) const {
    door_->advance(particles, begin, end, duration, integrator, report);
  }
  void integrate(PointIntegrator& integrator, CompositeState& s, const SymmetricTensor& strain,
                 double duration, PointReport& report) const {
    through(s, [&](PointState& p) { integrator.integrate(*door_, p, strain, duration, report); });
  }
  TangentEntries tangent(const CompositeState& s, const SymmetricTensor& strain, double duration) const {
    return door_->tangent(point(s), strain, duration);
  }
  double stored_energy(const CompositeState& s) const { return door_->stored_energy(point(s)); }
  double damage(const CompositeState& s) const { return door_->damage(point(s)); }
  /// Moduli that give the stress of a state.
  Moduli secant_moduli(const CompositeState& s) const {
    Moduli m = elastic_moduli(parameters().elastic);
    if (!parameters().damage || !(s.crack_density > 0.0)) return m;
    if (is_localised(s) && parameters().decohesion->undamaged) return m;
    const Moduli damaged =
        DamageLaw(*parameters().damage, parameters().elastic).moduli(s.crack_density / crack_density_limit);
    m.shear = damaged.shear;
    if (trace(s.elastic_strain) > 0.0) m.bulk = damaged.bulk;
    return m;
  }
  const CompositeModes& modes() const { return dynamic_cast<const CompositeModes&>(*door_->event_driven()); }

 private:
  PointState point(const CompositeState& s) const {
    PointState p;
    p.elastic_strain = s.elastic_strain, p.stress = s.stress;
    for (std::size_t k = 0; k < columns().size(); ++k) value_of(*door_, p, k) = number(s, columns()[k].name);
    p.dissipated = s.dissipated;
    return p;
  }
  CompositeState named(const PointState& p) const {
    CompositeState s;
    take(p, s);
    return s;
  }
  void take(const PointState& p, CompositeState& s) const {
    s.elastic_strain = p.elastic_strain, s.stress = p.stress;
    for (std::size_t k = 0; k < columns().size(); ++k) number(s, columns()[k].name) = value_of(*door_, p, k);
    s.dissipated = p.dissipated;
  }
  template <class Call>
  void through(CompositeState& s, Call&& call) const {
    PointState p = point(s);
    call(p);
    take(p, s);
  }

  std::shared_ptr<const Material> door_;
};

inline std::shared_ptr<const CompositeMaterial> composite_of(const MaterialParameters& parameters,
                                                             double cell) {
  return std::make_shared<CompositeMaterial>(parameters, cell);
}

}  // namespace vitrum::test
