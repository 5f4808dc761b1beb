#include "mpm/stress.hpp"

namespace vitrum::mpm {

TensorColumns stress_of(const Body& body) {
  const Particles& p = body.particles;
  TensorColumns stress;
  TensorPointers<const double> strain{};
  TensorPointers<double> to{};
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
