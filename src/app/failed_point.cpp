#include "app/failed_point.hpp"

#include <algorithm>
#include <limits>

#include "scene/write_scene.hpp"

namespace vitrum::app {

std::string failed_point(const Scene& scene, const System& system, const PointFailure& failure) {
  const Body& body = system.bodies[failure.body];
  const Particles& p = body.particles;
  const std::size_t i = failure.particle;
  const auto tensor = [i](const std::array<std::vector<double>, 4>& columns) {
    return SymmetricTensor{columns[0][i], columns[1][i], columns[2][i], columns[3][i]};
  };
  PointScene point;
  point.material = body.material->parameters();
  point.constitutive = scene.constitutive;
  point.state.elastic_strain = tensor(p.elastic_strain);
  for (std::size_t k = 0; k < variable_count; ++k)
    if (!p.variables[k].empty()) point.state.*variable_members[k] = p.variables[k][i];
  point.time = {0.0, failure.duration};
  if (failure.duration == 0.0) {
    // The times of a path increase. In an instant a viscous plane does nothing; the rate of damage stays what
    // it was.
    point.time[1] = std::numeric_limits<double>::min();
    if (auto& damage = point.material.damage; damage && damage->fixed_rate == 0.0)
      damage->fixed_rate = std::max(point.state.max_rate, damage->rate_floor);
  }
  point.strain = {{}, failure.increment};
  point.size = scene.cell;
  point.samples = 1;
  return point_toml(point);
}

}  // namespace vitrum::app
