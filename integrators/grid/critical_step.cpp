#include "integrators/grid/critical_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "mpm/contact/contact.hpp"

namespace vitrum {

double stability_limit(StepScheme scheme) {
  // USF and MUSL are leapfrog on the particle system, whose largest frequency is at most 2 sqrt(2) c/h for
  // any particle positions.
  return scheme == StepScheme::usl ? 0.5 : 1.0 / std::numbers::sqrt2;
}

double largest_speed(const Particles& p) {
  double largest = 0.0;
  for (std::size_t i = 0; i < p.size; ++i)
    largest = std::max(largest, p.velocity[0][i] * p.velocity[0][i] + p.velocity[1][i] * p.velocity[1][i]);
  return std::sqrt(largest);
}

double speed_as_stiff(double frequency_squared, double cell) {
  return cell * std::sqrt(frequency_squared / 8.0);
}

CriticalStep critical_step(const System& system, double limit, Touching touching, Speeds speeds) {
  CriticalStep result{std::numeric_limits<double>::infinity(), 0.0, 0.0, ""};
  std::vector<CriticalStep> of_bodies;
  for (const Body& body : system.bodies) {
    const double c = body.material->wave_speed(),
                 v = speeds == Speeds::of_waves ? 0.0 : largest_speed(body.particles);
    of_bodies.push_back({limit * system.cell / (c + v), c, v, body.name});
    if (of_bodies.back().step < result.step) result = of_bodies.back();
  }
  for (std::size_t n = 0; system.contact && n < system.contact->pairs().size(); ++n) {
    const mpm::BodyPair& pair = system.contact->pairs()[n];
    const double approach = of_bodies[pair.a].travel_speed + of_bodies[pair.b].travel_speed;
    if (touching == Touching::soon && !(system.contact->gap(n) <= approach * result.step)) continue;
    const double step =
        limit * system.cell / speed_as_stiff(system.contact->frequency_squared(n), system.cell);
    if (step < result.step)
      result = of_bodies[pair.a], result.step = step, result.touching = system.bodies[pair.b].name;
  }
  return result;
}

}  // namespace vitrum
