#include "app/failed_point.hpp"

#include <algorithm>
#include <limits>

#include "mpm/point.hpp"
#include "scene/write_scene.hpp"

namespace vitrum::app {

std::string failed_point(const Scene& scene, const System& system, const PointFailure& failure) {
  const Body& body = system.bodies[failure.body];
  PointScene point;
  point.material = body.material->parameters();
  point.constitutive = scene.constitutive;
  point.state = mpm::point_of(body, failure.particle);
  point.time = {0.0, failure.duration};
  if (failure.duration == 0.0) {
    // The times of a path increase. In an instant a viscous plane does nothing; the rate of damage stays what
    // it was.
    point.time[1] = std::numeric_limits<double>::min();
    if (auto& damage = point.material.damage; damage && damage->rate() != DamageRate::fixed)
      damage->fixed_rate =
          std::max(point.state.variables[*body.material->column("max_rate")], damage->rate_floor);
  }
  point.strain = {{}, failure.increment};
  point.size = scene.cell;
  point.samples = 1;
  return point_toml(point);
}

}  // namespace vitrum::app
