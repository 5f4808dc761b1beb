#pragma once
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "mpm/particles.hpp"

namespace vitrum::output {

/// Name and column of what every particle has, or of what is empty (without contact).
/// `ParticlesType`: Particles or const Particles.
template <class ParticlesType>
auto stored_columns(ParticlesType& particles) {
  using Column = std::remove_reference_t<decltype((particles.mass))>;
  std::vector<std::pair<std::string, Column*>> columns;
  const char* const components[] = {"rr", "zz", "tt", "rz"};
  columns.emplace_back("position_r", &particles.position[0]);
  columns.emplace_back("position_z", &particles.position[1]);
  columns.emplace_back("velocity_r", &particles.velocity[0]);
  columns.emplace_back("velocity_z", &particles.velocity[1]);
  columns.emplace_back("mass", &particles.mass);
  for (std::size_t c = 0; c < 4; ++c)
    columns.emplace_back(std::string("elastic_strain_") + components[c], &particles.elastic_strain[c]);
  columns.emplace_back("turn", &particles.turn), columns.emplace_back("mirrored", &particles.mirrored);
  for (std::size_t c = 0; c < 3; ++c)
    columns.emplace_back(std::string("stretch_") + components[c == 2 ? 3 : c], &particles.stretch[c]);
  columns.emplace_back("domain_r", &particles.domain[0]),
      columns.emplace_back("domain_z", &particles.domain[1]);
  return columns;
}

template <std::size_t n>
bool is_one_of(const std::array<std::vector<double>, n>& columns, const std::vector<double>& column) {
  return &column >= columns.data() && &column < columns.data() + n;
}

/// Whether a column is empty in some scenes.
inline bool may_be_absent(const Particles& p, const std::vector<double>& column) {
  return &column == &p.turn || &column == &p.mirrored || is_one_of(p.stretch, column) ||
         is_one_of(p.domain, column);
}

}  // namespace vitrum::output
