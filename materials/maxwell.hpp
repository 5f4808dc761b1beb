#pragma once
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "materials/elasticity.hpp"
#include "materials/law_state.hpp"
#include "materials/registry.hpp"
#include "schema/fields.hpp"

namespace vitrum {

/// Scene table [material.NAME.maxwell]: G(t) = G0 (1 - sum g_i (1 - exp(-t / tau_i))), a Prony series.
/// Young's modulus and Poisson's ratio of the material are the instantaneous ones: they give G0 and the bulk
/// modulus, which does not relax.
struct MaxwellParameters {
  std::vector<double> ratios;             ///< g_i; what their sum lacks of 1 lasts for ever
  std::vector<double> times;              ///< tau_i at the reference temperature, s
  double C1 = 0.0, C2 = 51.6;             ///< C2 in K
  double reference_temperature = 293.15;  ///< K
  double temperature = 293.15;            ///< K

  static schema::Fields<MaxwellParameters> rows();
  /// a_T, the factor of all times at `temperature`: lg a_T = -C1 (T - T_ref) / (C2 + T - T_ref). M. L.
  /// Williams, R. F. Landel and J. D. Ferry, J. Am. Chem. Soc. 77 (1955), 3701-3707.
  double shift() const;
};

/// Generalised Maxwell viscoelasticity: an elastic branch that lasts beside branches of a spring (shear
/// modulus g_i G0) and a dashpot in series. Stored: the strain and, for each branch, the strain of its
/// spring, a deviator. Exact for a constant strain rate. Theory: docs/theory/other-laws.md.
class Maxwell {
 public:
  static constexpr std::size_t most_branches = 11;  // of four columns each, see most_columns
  using Parameters = MaxwellParameters;
  struct State : LawState {
    std::array<SymmetricTensor, most_branches> springs{};
  };

  Maxwell(const ElasticParameters& elastic, const Parameters& parameters, double cell);

  static std::optional<Contradiction> contradiction(const ElasticParameters& elastic,
                                                    const Parameters& parameters);
  static std::vector<Variable> all_variables();
  std::vector<Variable> variables() const;
  void members(auto& state, auto&& f) const {
    for (std::size_t i = 0; i < branches_.size(); ++i) f(state.springs[i]);
  }
  Moduli elastic() const { return instantaneous_; }
  double strain_scale() const { return 1.0e-3; }
  void start(const SymmetricTensor& stress, State& state) const;
  void advance(State& state, const SymmetricTensor& strain, double duration, PointReport& report) const;
  SymmetricTensor stress(const State& state) const;
  double stored_energy(const State& state) const;

  struct Branch {
    double shear;  ///< of its spring, Pa
    double time;   ///< of relaxation, s, at the temperature of the material
  };
  std::span<const Branch> branches() const { return branches_; }

 private:
  Moduli instantaneous_, lasting_;
  std::vector<Branch> branches_;
};

}  // namespace vitrum
