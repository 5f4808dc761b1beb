#pragma once
#include <optional>
#include <span>
#include <vector>

#include "materials/elasticity.hpp"
#include "materials/law_state.hpp"
#include "materials/registry.hpp"
#include "materials/scatter.hpp"
#include "schema/fields.hpp"

namespace vitrum {

/// Scene table [material.NAME.johnson_holmquist]. G. R. Johnson and T. J. Holmquist, "An improved
/// computational constitutive model for brittle materials", High-Pressure Science and Technology 1993, AIP
/// Conf. Proc. 309 (1994), pp. 981-984, whose letters the keys keep. K1 and G are the bulk and the shear
/// modulus of the material's elasticity.
struct JohnsonHolmquistParameters {
  double A = 0.0, N = 0.0;                                           ///< intact strength
  double B = 0.0, M = 0.0;                                           ///< fractured strength
  double fractured_limit = std::numeric_limits<double>::infinity();  ///< of the normalised fractured strength
  double C = 0.0;                                                    ///< of the logarithm of the rate
  double reference_rate = 1.0;                                       ///< 1/s
  double T = 0.0;                                                    ///< largest hydrostatic tension, Pa
  double HEL = 0.0, PHEL = 0.0;                 ///< Hugoniot elastic limit and the pressure there, Pa
  double D1 = 0.0, D2 = 0.0;                    ///< plastic strain to fracture
  double K2 = 0.0, K3 = 0.0;                    ///< equation of state, Pa
  double beta = 1.0;                            ///< share of the lost elastic energy that bulks
  std::optional<StrengthScatter> scatter = {};  ///< of T; none: every point is the same

  static schema::Fields<JohnsonHolmquistParameters> rows();
};

/// JH-2: a strength that falls from an intact to a fractured curve, both growing with pressure and rate, as
/// plastic strain uses up what the pressure admits; a polynomial equation of state, to which the elastic
/// energy that fracture sets free adds pressure (bulking). Nothing flows in volume: the trace of the strain
/// is ln(V/V0). Theory: docs/theory/other-laws.md.
class JohnsonHolmquist {
 public:
  using Parameters = JohnsonHolmquistParameters;
  struct State : LawState {
    double damage = 0.0;           ///< 0: intact, 1: fractured
    double bulking = 0.0;          ///< pressure that fracture has added, Pa
    double strength_factor = 1.0;  ///< of T
  };

  JohnsonHolmquist(const ElasticParameters& elastic, const Parameters& parameters, double cell);

  static std::optional<Contradiction> contradiction(const ElasticParameters& elastic,
                                                    const Parameters& parameters);
  static std::vector<Variable> all_variables();
  std::vector<Variable> variables() const;
  void members(auto& state, auto&& f) const {
    f(state.damage), f(state.bulking);
    if (parameters_.scatter) f(state.strength_factor);
  }
  const std::optional<StrengthScatter>& scatter() const { return parameters_.scatter; }
  std::optional<std::size_t> damage_column() const { return 0; }
  Moduli elastic() const { return elastic_; }
  double strain_scale() const { return parameters_.HEL / elastic_.p_wave(); }
  void start(const SymmetricTensor& stress, State& state) const;
  void judge(State& state, PointReport& report) const { advance(state, {}, 0.0, report); }
  void advance(State& state, const SymmetricTensor& strain, double duration, PointReport& report) const;
  /// Of the reference volume (docs/theory/strain-and-stress.md), Pa.
  SymmetricTensor stress(const State& state) const;
  double stored_energy(const State& state) const;

  /// Pressure of a state, Pa of the present area.
  double pressure(const State& state) const;
  /// Equivalent stress that intact and fractured material bear at a pressure, of those that bear a
  /// hydrostatic tension (Pa, positive), and a strain rate (1/s), Pa of the present area.
  struct Strength {
    double intact, fractured;
    double at(double damage) const { return intact - damage * (intact - fractured); }
  };
  Strength strength(double pressure, double tension, double rate) const;
  /// Plastic strain that fractures such intact material at a pressure.
  double fracture_strain(double pressure, double tension) const;
  /// Largest hydrostatic tension of a point that is intact, Pa.
  double tension(const State& state) const { return state.strength_factor * parameters_.T; }

 private:
  double equation_of_state(double mu) const;
  double unlimited_pressure(const State& state) const;
  double equivalent_stress(const SymmetricTensor& elastic_strain) const;
  struct Flow {
    double plastic_strain = 0.0;  ///< equivalent
    double stress = 0.0;          ///< equivalent, of the reference volume, at the end
    double bulked = 0.0;          ///< elastic energy that became bulking, J/m^3
  };
  Flow flow(State& state, double trial, double rate) const;
  bool fails_in_tension(const State& state, double pressure) const;
  void open_in_tension(State& state, double tension, PointReport& report) const;

  Parameters parameters_;
  Moduli elastic_;
};

}  // namespace vitrum
