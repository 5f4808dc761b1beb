#include "mpm/stress.hpp"

namespace vitrum::mpm {

std::array<std::vector<double>, 4> stress_of(const Body& body) {
  const Particles& p = body.particles;
  std::array<std::vector<double>, 4> stress;
  std::array<const double*, 4> strain{};
  std::array<double*, 4> to{};
  for (std::size_t c = 0; c < 4; ++c) {
    stress[c].resize(p.size);
    strain[c] = p.elastic_strain[c].data(), to[c] = stress[c].data();
  }
  VariableColumns<const double*> variables;
  for (const auto& column : p.variables) variables.push_back(column.data());
  body.material->stress(strain, variables, p.size, to);
  return stress;
}

}  // namespace vitrum::mpm
