#include "materials/composite/make.hpp"
#include "schema/field.hpp"

namespace vitrum {
using intervals::not_negative, intervals::positive;
using schema::required;

schema::Fields<ElasticParameters> ElasticParameters::rows() {
  using P = ElasticParameters;
  return {
      {"density", &P::density, "kg/m^3", positive, "mass density", required},
      {"young", &P::young, "Pa", positive, "Young's modulus", required},
      {"poisson", &P::poisson, "1", {-1.0, 0.5, true, true}, "Poisson's ratio", required},
  };
}

schema::Fields<DamageParameters> DamageParameters::rows() {
  using P = DamageParameters;
  return {
      {"toughness", &P::toughness, "Pa m^0.5", positive, "fracture toughness K_IC, eq. 7", required},
      {"k", &P::k, "1/m^3", positive, "flaw density parameter k, eq. 7", required},
      {"m", &P::m, "1", {1.0, 100.0, true}, "exponent m of the mean strain, eq. 7", required},
      {"rate_floor", &P::rate_floor, "1/s", positive, "least strain rate that enters eq. 7"},
      {"scatter", &P::scatter, StrengthScatter::table(),
       "flaws: the strength s of each point, by k / s^m in place of k; absent: none"},
  };
}

schema::Fields<DruckerPragerParameters> DruckerPragerParameters::rows() {
  using P = DruckerPragerParameters;
  return {
      {"yield", &P::yield, "Pa", positive, "yield strength at zero pressure sigma_y, eq. 19", required},
      {"beta", &P::beta, "1", not_negative, "pressure sensitivity beta, eq. 19", required},
  };
}

schema::Fields<VonMisesParameters> VonMisesParameters::rows() {
  using P = VonMisesParameters;
  return {
      {"yield", &P::yield, "Pa", positive, "yield strength sigma_y, eq. 21", required},
      {"peak", &P::peak, "Pa", positive, "peak strength sigma_p, eq. 21", required},
      {"hardening", &P::hardening, "Pa", not_negative, "hardening modulus E_h, eq. 21", required},
      {"softening", &P::softening, "Pa", not_negative, "softening modulus E_s, eq. 21", required},
  };
}

schema::Fields<DecohesionParameters> DecohesionParameters::rows() {
  using P = DecohesionParameters;
  return {
      {"opening", &P::opening, "m", positive, "reference decohesion u0, eq. 15", required},
      {"q", &P::q, "1", {0.0, 100.0, true}, "exponent q of the softening, eq. 13"},
      {"mode_ratio", &P::mode_ratio, "1", positive, "C_m = tau_tp / tau_np, eq. 18", required},
      {"viscosity", &P::viscosity, "s", not_negative,
       "viscosity eta of eta lambda' = <f>/U0; 0: a snap-back releases at once"},
      {"tau_bar_0", &P::tau_bar_0, "Pa", positive,
       "reference traction of U0 = u0 tau_bar_0; absent: tau_np of the onset, eq. 18"},
      {"pressure_counts", &P::pressure_counts,
       "eqs. 15 to 18 as printed, with the square of tau_n whatever its sign; false: only tension drives "
       "decohesion"},
      {"partial_compression", &P::partial_compression,
       "damage localises although a principal stress is compressive; false: only where none is"},
      {"flow_behind_plane", &P::flow_behind_plane, "a localised point may still flow; false: elastic"},
      {"friction",
       &P::friction,
       "1",
       {0.0, 100.0},
       "Coulomb's coefficient between the faces of a separated plane; its work is booked as plastic"},
  };
}

std::vector<Variable> damage_variables() {
  return {
      {.name = "crack_density",
       .unit = "1",
       .text = "crack density rho_d, eq. 7",
       .scale = crack_density_limit,
       .bounds = {0.0, crack_density_limit}},
      {.name = "max_rate",
       .unit = "1/s",
       .text = "strain rate that enters eq. 7 (`damage.rate`): by default the largest so far under tension",
       .scale = 1.0e3,
       .bounds = not_negative}};
}

std::vector<Variable> averaged_rate_variables() {
  return {{.name = "mean_rate",
           .unit = "1/s",
           .text = "rate of eps_v averaged over a time (`damage.rate`)",
           .scale = 1.0e3}};
}

std::vector<Variable> plasticity_variables() {
  return {{.name = "plastic_strain",
           .unit = "1",
           .text = "accumulated plastic strain I, the integral of |d eps_p|, eq. 23",
           .scale = 1.0e-2,
           .bounds = not_negative}};
}

std::vector<Variable> decohesion_variables() {
  return {{.name = "decohesion",
           .unit = "1",
           .text = "decohesion lambda, eq. 13; 1 means separated",
           .bounds = {0.0, 1.0}},
          {.name = "opening_n",
           .unit = "m",
           .text = "normal opening of the decohesion plane, eq. 14",
           .scale = 1.0e-6},
          {.name = "opening_t",
           .unit = "m",
           .text = "tangential opening of the decohesion plane, eq. 14",
           .parity = Parity::odd,
           .scale = 1.0e-6},
          {.name = "normal",
           .unit = "1",
           .text = "the normal of the decohesion plane; both components 0: hoop plane or intact",
           .kind = Kind::vector,
           .bounds = {-1.0, 1.0}},
          {.name = "effective_length",
           .unit = "m",
           .text = "effective length L_e, eq. 12; 0 means not localised",
           .scale = 1.0e-3,
           .bounds = not_negative},
          {.name = "cohesive_strength",
           .unit = "Pa",
           .text = "traction tau_np at the onset of decohesion, eq. 18",
           .scale = 1.0e8,
           .bounds = not_negative}};
}

}  // namespace vitrum
