#include "observe/removed.hpp"

#include "mpm/removal.hpp"

namespace vitrum {

std::unique_ptr<Observer> RemovedParticles::make(const Scene& /*scene*/, const System& system) {
  return mpm::removes(system) ? std::make_unique<RemovedParticles>() : nullptr;
}

RemovedParticles::RemovedParticles() {
  table_.patience = std::size_t{1} << 14;  // bytes
}

void RemovedParticles::step(const System& system, double /*duration*/) {
  for (const RemovedParticle& r : system.record.left)
    table_.row(system.time, system.bodies[r.body].name, r.identity, r.place[0], r.place[1], r.velocity[0],
               r.velocity[1], whole_body(system) * r.mass);
}

}  // namespace vitrum
