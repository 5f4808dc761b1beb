#include "mpm/point.hpp"

namespace vitrum::mpm {

PointState point_of(const Body& body, std::size_t i) {
  const Particles& p = body.particles;
  PointState s;
  s.elastic_strain = tensor_at(p.elastic_strain, i);
  for (std::size_t k = 0; k < p.variables.size(); ++k) value_of(*body.material, s, k) = p.variables[k][i];
  s.stress = body.material->stress(s);
  return s;
}

void put_point(const PointState& s, Body& body, std::size_t i) {
  Particles& p = body.particles;
  put_tensor(p.elastic_strain, i, s.elastic_strain);
  for (std::size_t k = 0; k < p.variables.size(); ++k) p.variables[k][i] = value_of(*body.material, s, k);
}

}  // namespace vitrum::mpm
