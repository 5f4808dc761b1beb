#include <array>
#include <limits>

#include "materials/material_parameters.hpp"

namespace vitrum {
namespace {
constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr Bounds positive{0.0, infinite, true, true};
constexpr Bounds not_negative{0.0, infinite, false, true};
constexpr Bounds any{-infinite, infinite, true, true};
}  // namespace

std::span<const ParameterInfo<ElasticParameters>> ElasticParameters::describe() {
  using P = ElasticParameters;
  static constexpr std::array<ParameterInfo<P>, 3> table{{
      {"density", &P::density, "kg/m^3", {}, positive, "mass density"},
      {"young", &P::young, "Pa", {}, positive, "Young's modulus"},
      {"poisson", &P::poisson, "1", {}, {-1.0, 0.5, true, true}, "Poisson's ratio"},
  }};
  return table;
}

std::span<const ParameterInfo<DamageParameters>> DamageParameters::describe() {
  using P = DamageParameters;
  static constexpr std::array<ParameterInfo<P>, 4> table{{
      {"toughness", &P::toughness, "Pa m^0.5", {}, positive, "fracture toughness K_IC, eq. 7"},
      {"k", &P::k, "1/m^3", {}, positive, "flaw density parameter k, eq. 7"},
      {"m", &P::m, "1", {}, {1.0, 100.0, true}, "exponent m of the mean strain, eq. 7"},
      {"rate_floor", &P::rate_floor, "1/s", 1.0, positive, "least strain rate that enters eq. 7"},
  }};
  return table;
}

std::span<const ParameterInfo<DruckerPragerParameters>> DruckerPragerParameters::describe() {
  using P = DruckerPragerParameters;
  static constexpr std::array<ParameterInfo<P>, 2> table{{
      {"yield", &P::yield, "Pa", {}, positive, "yield strength at zero pressure sigma_y, eq. 19"},
      {"beta", &P::beta, "1", {}, not_negative, "pressure sensitivity beta, eq. 19"},
  }};
  return table;
}

std::span<const ParameterInfo<VonMisesParameters>> VonMisesParameters::describe() {
  using P = VonMisesParameters;
  static constexpr std::array<ParameterInfo<P>, 4> table{{
      {"yield", &P::yield, "Pa", {}, positive, "yield strength sigma_y, eq. 21"},
      {"peak", &P::peak, "Pa", {}, positive, "peak strength sigma_p, eq. 21"},
      {"hardening", &P::hardening, "Pa", {}, not_negative, "hardening modulus E_h, eq. 21"},
      {"softening", &P::softening, "Pa", {}, not_negative, "softening modulus E_s, eq. 21"},
  }};
  return table;
}

std::span<const ParameterInfo<DecohesionParameters>> DecohesionParameters::describe() {
  using P = DecohesionParameters;
  static constexpr std::array<ParameterInfo<P>, 4> table{{
      {"opening", &P::opening, "m", {}, positive, "reference decohesion u0, eq. 15"},
      {"q", &P::q, "1", 1.0, {0.0, 100.0, true}, "exponent q of the softening, eq. 13"},
      {"mode_ratio", &P::mode_ratio, "1", {}, positive, "C_m = tau_tp / tau_np, eq. 18"},
      {"viscosity", &P::viscosity, "s", 0.0, not_negative,
       "viscosity eta of eta lambda' = <f>/U0; 0: a snap-back releases at once"},
  }};
  return table;
}

std::span<const VariableInfo> all_variables() {
  using V = Variable;
  static constexpr std::array<VariableInfo, variable_count> table{{
      {V::crack_density,
       "crack_density",
       "1",
       crack_density_limit,
       {0.0, crack_density_limit},
       "crack density rho_d, eq. 7"},
      {V::max_rate, "max_rate", "1/s", 1.0e3, not_negative,
       "running maximum of the tensile mean strain rate, eq. 7"},
      {V::plastic_strain, "plastic_strain", "1", 1.0e-2, not_negative,
       "accumulated plastic strain I, the integral of |d eps_p|, eq. 23"},
      {V::decohesion, "decohesion", "1", 1.0, {0.0, 1.0}, "decohesion lambda, eq. 13; 1 means separated"},
      {V::opening_n, "opening_n", "m", 1.0e-6, any, "normal opening of the decohesion plane, eq. 14"},
      {V::opening_t, "opening_t", "m", 1.0e-6, any, "tangential opening of the decohesion plane, eq. 14"},
      {V::normal_r,
       "normal_r",
       "1",
       1.0,
       {-1.0, 1.0},
       "r (x) component of the normal of the decohesion plane; both components 0: hoop plane or intact"},
      {V::normal_z,
       "normal_z",
       "1",
       1.0,
       {-1.0, 1.0},
       "z (y) component of the normal of the decohesion plane"},
      {V::effective_length, "effective_length", "m", 1.0e-3, not_negative,
       "effective length L_e, eq. 12; 0 means not localised"},
      {V::cohesive_strength, "cohesive_strength", "Pa", 1.0e8, not_negative,
       "traction tau_np at the onset of decohesion, eq. 18"},
      {V::dissipated, "dissipated", "J/m^3", 1.0e4, not_negative,
       "energy dissipated by all models, per volume of material"},
  }};
  return table;
}

}  // namespace vitrum
