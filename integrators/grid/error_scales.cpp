#include "integrators/grid/error_scales.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vitrum {

ErrorScales error_scales(const System& system, const GivenScales& given) {
  ErrorScales scales{0.0, std::numeric_limits<double>::infinity(), system.cell};
  double wave_speed = 0.0;
  for (const Body& body : system.bodies) {
    scales.strain = std::min(scales.strain, body.material->strain_scale());
    wave_speed = std::max(wave_speed, body.material->wave_speed());
    for (std::size_t i = 0; i < body.particles.size; ++i)
      scales.velocity =
          std::max(scales.velocity, std::hypot(body.particles.velocity[0][i], body.particles.velocity[1][i]));
  }
  for (const mpm::Boundary& wall : system.grid.boundaries())
    for (std::size_t c = 0; c < 2; ++c)
      if (wall.fixed[c]) scales.velocity = std::max(scales.velocity, wall.top_speed(c));
  if (given.strain) scales.strain = *given.strain;
  scales.velocity = std::max(scales.velocity, wave_speed * scales.strain);
  if (given.velocity) scales.velocity = *given.velocity;
  return scales;
}

double tolerated_energy(const System& system, const ErrorScales& scales, double tolerance) {
  double mass = 0.0;
  for (const Body& body : system.bodies)
    for (const double m : body.particles.mass) mass += m;
  return mass * tolerance * tolerance * scales.velocity * scales.velocity;
}

}  // namespace vitrum
