#include "mpm/trial.hpp"

namespace vitrum::mpm {
namespace {

template <std::size_t n>
void swap_columns(std::array<std::vector<double>, n>& one, std::array<std::vector<double>, n>& other) {
  for (std::size_t k = 0; k < n; ++k)
    if (!one[k].empty()) one[k].swap(other[k]);
}

}  // namespace

Trial::Trial(const System& system, Moves moves) : columns_(system.bodies.size()) {
  for (std::size_t n = 0; n < columns_.size(); ++n) {
    const Particles& p = system.bodies[n].particles;
    columns_[n].elastic_strain = p.elastic_strain;
    for (auto& column : columns_[n].stress) column.assign(p.size, 0.0);
    if (moves == Moves::particles)
      columns_[n].position = p.position, columns_[n].velocity = p.velocity;
    else
      columns_[n].stress_zr.assign(p.size, 0.0);
  }
}

void Trial::exchange(System& system) {
  for (std::size_t n = 0; n < columns_.size(); ++n) {
    Particles& p = system.bodies[n].particles;
    swap_columns(columns_[n].position, p.position);
    swap_columns(columns_[n].velocity, p.velocity);
    swap_columns(columns_[n].elastic_strain, p.elastic_strain);
    columns_[n].stress.swap(p.tried_stress);
    columns_[n].stress_zr.swap(p.tried_stress_zr);
  }
}

}  // namespace vitrum::mpm
