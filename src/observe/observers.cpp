#include "observe/observers.hpp"

#include "observe/registry.hpp"

namespace vitrum {

Observers::Observers(const Scene& scene, const System& system) {
  for (const ObserverKind& kind : observer_kinds())
    if (std::unique_ptr<Observer> observer = kind.make(scene, system))
      seats_.push_back({std::move(observer)});
}

/// Once a moment, whatever asks for it.
void Observers::tell(const System& system, Seat& seat) {
  if (seat.told != system.step_index) seat.observer->tell(system);
  seat.told = system.step_index;
  seat.observer->table()->cadence.pass(system.time);
}

void Observers::step(const System& system, double duration) {
  for (const Seat& seat : seats_) seat.observer->step(system, duration);
  for (Seat& seat : seats_)
    if (const Table* table = seat.observer->table())
      if ((table->cadence.is_due(system.time) || (duration == 0.0 && !table->cadence.at_outputs())) &&
          (system.record.particles_moved || !table->needs_particles))
        tell(system, seat);
}

void Observers::tell_output(const System& system) {
  for (Seat& seat : seats_)
    if (const Table* table = seat.observer->table(); table != nullptr && table->cadence.at_outputs())
      tell(system, seat);
}

void Observers::tell_last(const System& system) {
  for (Seat& seat : seats_)
    if (seat.observer->table() != nullptr) tell(system, seat);
}

std::vector<Quantity> Observers::quantities(const System& system) const {
  std::vector<Quantity> all;
  for (const Seat& seat : seats_) seat.observer->declare(system, all);
  return all;
}

std::vector<Table*> Observers::tables() const {
  std::vector<Table*> tables;
  for (const Seat& seat : seats_)
    if (Table* table = seat.observer->table()) tables.push_back(table);
  return tables;
}

void Observers::save(Archive& archive) const {
  for (const Seat& seat : seats_) {
    seat.observer->save(archive);
    if (const Table* table = seat.observer->table()) {
      archive.put(table->name() + ".told", static_cast<double>(seat.told + 1));
      table->save(archive);
    }
  }
}

void Observers::restore(const Archive& archive) {
  for (Seat& seat : seats_) {
    seat.observer->restore(archive);
    if (Table* table = seat.observer->table()) {
      seat.told = archive.count(table->name() + ".told") - 1;
      table->restore(archive);
    }
  }
}

}  // namespace vitrum
