#pragma once
#include <optional>
#include <span>
#include <vector>

#include "materials/elasticity.hpp"
#include "materials/law_state.hpp"
#include "materials/registry.hpp"
#include "schema/fields.hpp"

namespace vitrum {

/// Scene table [material.NAME.johnson_cook]. G. R. Johnson and W. H. Cook, Proc. 7th Int. Symp. on
/// Ballistics, The Hague 1983, pp. 541-547, whose letters the keys keep.
struct JohnsonCookParameters {
  double A = 0.0, B = 0.0;               ///< yield strength and hardening, Pa
  double n = 1.0;                        ///< exponent of the plastic strain
  double C = 0.0;                        ///< of the logarithm of the rate
  double m = 1.0;                        ///< exponent of the temperature
  double reference_rate = 1.0;           ///< 1/s
  double reference_temperature = 298.0;  ///< K; T* = 0
  double melting_temperature = 0.0;      ///< K; T* = 1
  double temperature = 298.0;            ///< K, at the start
  double heat_capacity = 0.0;            ///< J/(kg K)
  double heat_fraction = 0.9;            ///< of the plastic work (Taylor and Quinney); 0: isothermal

  static schema::Fields<JohnsonCookParameters> rows();
};

/// sigma_y = (A + B eps^n) (1 + C ln(rate / reference rate)) (1 - T*^m) on isotropic elasticity: the strength
/// of metals at high rates, softened by the heat of the plastic work. Neither rates nor temperatures below
/// their references harden, and molten metal has no strength. Theory: docs/theory/other-laws.md.
class JohnsonCook {
 public:
  using Parameters = JohnsonCookParameters;
  struct State : LawState {
    double plastic_strain = 0.0;  ///< the integral of (2/3 d:d)^(1/2)
    double temperature = 0.0;     ///< K
  };

  JohnsonCook(const ElasticParameters& elastic, const Parameters& parameters, double cell);

  static std::optional<Contradiction> contradiction(const ElasticParameters& elastic,
                                                    const Parameters& parameters);
  static std::vector<Variable> all_variables();
  std::vector<Variable> variables() const;
  void members(auto& state, auto&& f) const {
    f(state.plastic_strain);
    if (heats()) f(state.temperature);
  }
  Moduli elastic() const { return elastic_; }
  double strain_scale() const { return parameters_.A / (3.0 * elastic_.shear); }
  void start(const SymmetricTensor& stress, State& state) const {
    state.elastic_strain = elastic_.strain(stress);
  }
  void judge(State& state, PointReport& report) const { advance(state, {}, 0.0, report); }
  void advance(State& state, const SymmetricTensor& strain, double duration, PointReport& report) const;
  SymmetricTensor stress(const State& state) const { return elastic_.stress(state.elastic_strain); }
  double stored_energy(const State& state) const { return elastic_.energy(state.elastic_strain); }
  std::vector<std::size_t> stress_columns() const { return {}; }

  /// sigma_y, Pa. rate: of the plastic strain, 1/s; temperature: K.
  double strength(double plastic_strain, double rate, double temperature) const;

 private:
  bool heats() const { return kelvin_per_work_ > 0.0; }

  Parameters parameters_;
  Moduli elastic_;
  double kelvin_per_work_;  // K per J/m^3
};

}  // namespace vitrum
