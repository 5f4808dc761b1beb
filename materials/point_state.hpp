#pragma once
#include <array>
#include <cstddef>
#include <string_view>

#include "tensor/symmetric.hpp"

namespace vitrum {

/// The scalar internal variables that the laws of this folder know. A material stores only those its models
/// need.
enum class Variable : std::size_t {
  crack_density,
  max_rate,
  plastic_strain,
  decohesion,
  opening_n,
  opening_t,
  normal_r,
  normal_z,
  effective_length,
  cohesive_strength,
  dissipated,
};
inline constexpr std::size_t variable_count = 11;

/// One material point, with room for every variable of every law (those of absent models stay at their
/// initial value).
struct PointState {
  SymmetricTensor elastic_strain{};
  SymmetricTensor stress{};    ///< Pa; always the law's stress of `elastic_strain` and the internal variables
  double crack_density = 0.0;  ///< rho_d, eq. 7
  double max_rate = 0.0;       ///< running maximum of the tensile mean strain rate, 1/s, eq. 7
  double plastic_strain = 0.0;  ///< I, eq. 23
  double decohesion = 0.0;      ///< lambda, eq. 13; 1: separated
  double opening_n = 0.0;       ///< normal decohesion, m, eq. 14
  double opening_t = 0.0;       ///< tangential decohesion, m, eq. 14 (t is n turned by +90 degrees)
  double normal_r = 0.0;        ///< unit normal of the decohesion plane; both components 0: the hoop plane
  double normal_z = 0.0;
  double effective_length = 0.0;   ///< L_e, m, eq. 12; 0: not localised
  double cohesive_strength = 0.0;  ///< tau_np, Pa, eq. 18
  double dissipated = 0.0;         ///< energy dissipated by all models so far, J per m^3 of material
};

/// Where each Variable lives in PointState, in the order of the enumeration.
inline constexpr std::array<double PointState::*, variable_count> variable_members = {
    &PointState::crack_density,     &PointState::max_rate,  &PointState::plastic_strain,
    &PointState::decohesion,        &PointState::opening_n, &PointState::opening_t,
    &PointState::normal_r,          &PointState::normal_z,  &PointState::effective_length,
    &PointState::cohesive_strength, &PointState::dissipated};

constexpr bool is_localised(const PointState& s) {
  return s.effective_length > 0.0;
}
constexpr bool is_separated(const PointState& s) {
  return s.decohesion >= 1.0;
}

}  // namespace vitrum
