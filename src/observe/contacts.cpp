#include "observe/contacts.hpp"

#include "mpm/contact/contact.hpp"
#include "observe/registry.hpp"

namespace vitrum {

std::unique_ptr<Observer> ContactHistories::make(const Scene& scene, const System& system) {
  if (!system.contact) return nullptr;
  auto history = std::make_unique<ContactHistories>();
  history->table_.cadence = history_cadence(scene);
  return history;
}

void ContactHistories::tell(const System& system) {
  const double whole = whole_body(system);
  for (std::size_t n = 0; n < system.contact->pairs().size(); ++n) {
    const mpm::BodyPair& pair = system.contact->pairs()[n];
    const mpm::ContactHistory& history = system.contact->history()[n];
    table_.row(system.time, system.bodies[pair.a].name, system.bodies[pair.b].name,
               whole * history.impulse[0], whole * history.impulse[1], whole * history.friction_work,
               history.least_gap);
  }
}

}  // namespace vitrum
