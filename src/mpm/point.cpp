#include "mpm/point.hpp"

namespace vitrum::mpm {

PointState point_of(const Body& body, std::size_t i) {
  const Particles& p = body.particles;
  PointState s;
  s.elastic_strain = {p.elastic_strain[0][i], p.elastic_strain[1][i], p.elastic_strain[2][i],
                      p.elastic_strain[3][i]};
  for (std::size_t k = 0; k < p.variables.size(); ++k) value_of(*body.material, s, k) = p.variables[k][i];
  s.stress = body.material->stress(s);
  return s;
}

void put_point(const PointState& s, Body& body, std::size_t i) {
  Particles& p = body.particles;
  const SymmetricTensor& e = s.elastic_strain;
  const std::array<double, 4> strain{e.rr, e.zz, e.tt, e.rz};
  for (std::size_t c = 0; c < 4; ++c) p.elastic_strain[c][i] = strain[c];
  for (std::size_t k = 0; k < p.variables.size(); ++k) p.variables[k][i] = value_of(*body.material, s, k);
}

}  // namespace vitrum::mpm
