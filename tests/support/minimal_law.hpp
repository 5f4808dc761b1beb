#pragma once
#include <cmath>

#include "materials/batch.hpp"

namespace vitrum::test {

/// What a law comes down to: plasticity with linear kinematic hardening (Prager). It stores a tensor, the
/// plastic strain, which must turn with the particle.
struct MinimalLaw {
  struct State : LawState {
    SymmetricTensor plastic_strain{};
  };
  Moduli moduli;
  double radius, hardening;  // of |s - X|, and X per plastic strain, Pa

  std::vector<Variable> variables() const {
    return {{.name = "plastic", .unit = "1", .text = "plastic strain", .kind = Kind::symmetric}};
  }
  void members(auto& s, auto&& f) const { f(s.plastic_strain); }
  Moduli elastic() const { return moduli; }
  double strain_scale() const { return radius / moduli.shear; }
  void start(const SymmetricTensor& stress, State& s) const { s.elastic_strain = moduli.strain(stress); }
  void advance(State& s, const SymmetricTensor& strain, double, PointReport& report) const {
    s.elastic_strain += strain;
    const SymmetricTensor driving =
        2.0 * moduli.shear * deviator(s.elastic_strain) - hardening * s.plastic_strain;
    const double size = norm(driving);
    if (size <= radius) return;
    const double flow = (size - radius) / (2.0 * moduli.shear + hardening);
    const SymmetricTensor flowed = (flow / size) * driving;
    s.elastic_strain -= flowed, s.plastic_strain += flowed;
    report.dissipation.plastic += radius * flow;
  }
  SymmetricTensor stress(const State& s) const { return moduli.stress(s.elastic_strain); }
  double stored_energy(const State& s) const {
    return moduli.energy(s.elastic_strain) + 0.5 * hardening * contract(s.plastic_strain, s.plastic_strain);
  }
};

inline std::shared_ptr<const Material> minimal_material() {
  MaterialParameters p;
  p.name = "minimal";
  p.elastic = {7800.0, 195.0e9, 0.25};
  return std::make_shared<Batch<MinimalLaw>>(p, MinimalLaw{elastic_moduli(p.elastic), 300.0e6, 20.0e9});
}

}  // namespace vitrum::test
