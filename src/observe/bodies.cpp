#include "observe/bodies.hpp"

#include <algorithm>

#include "observe/energy_ledger.hpp"
#include "observe/failure.hpp"
#include "observe/fragments.hpp"
#include "observe/registry.hpp"

namespace vitrum {

BodyMotion motion_of(const Body& body, double whole) {
  BodyMotion motion;
  const Particles& p = body.particles;
  for (std::size_t i = 0; i < body.present(); ++i) {
    const double m = whole * p.mass[i];
    motion.mass += m;
    for (std::size_t k = 0; k < 2; ++k) {
      motion.momentum[k] += m * p.velocity[k][i];
      motion.centre[k] += m * p.position[k][i];
      motion.kinetic += 0.5 * m * p.velocity[k][i] * p.velocity[k][i];
    }
  }
  for (double& c : motion.centre) c /= motion.mass;
  return motion;
}

std::unique_ptr<Observer> BodyHistory::make(const Scene& scene, const System& /*system*/) {
  auto history = std::make_unique<BodyHistory>();
  history->table_.cadence = history_cadence(scene);
  return history;
}

void BodyHistory::tell(const System& system) {
  const double whole = whole_body(system);
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    const Body& body = system.bodies[n];
    const BodyMotion motion = motion_of(body, whole);
    const Failed failed = failed_part(body, whole);
    std::size_t pieces = 1;
    double largest = motion.mass;
    if (failed.separated > 0) {
      const std::vector<Fragment> all = fragments(system, pieces_of(system, n));  // by falling mass
      pieces = all.size(), largest = all.empty() ? 0.0 : all.front().mass;
    }
    table_.row(system.time, body.name, motion.momentum[0], motion.momentum[1], motion.centre[0],
               motion.centre[1], motion.kinetic, whole * stored_energy(body), failed.localised,
               failed.separated, pieces, largest, failed.crack_area, failed.volume);
  }
}

}  // namespace vitrum
