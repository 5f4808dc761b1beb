#include "observe/registry.hpp"

#include "observe/bodies.hpp"
#include "observe/contacts.hpp"
#include "observe/energy_ledger.hpp"
#include "observe/events.hpp"
#include "observe/failure.hpp"
#include "observe/probes.hpp"
#include "observe/reactions.hpp"
#include "observe/removed.hpp"

namespace vitrum {
namespace {

template <class Type>
constexpr ObserverKind kind() {
  if constexpr (requires { Type::table_info; })
    return {&Type::table_info, Type::make};
  else
    return {nullptr, Type::make};
}

constexpr ObserverKind kinds[] = {
    kind<EnergyLedger>(),      // energy.csv
    kind<FailureAnalysis>(),   // the summary and the series
    kind<EventLog>(),          // events.csv
    kind<BodyHistory>(),       // bodies.csv
    kind<ReactionHistory>(),   // reactions.csv
    kind<ContactHistories>(),  // contacts.csv
    kind<ProbeHistory>(),      // probes.csv
    kind<RemovedParticles>(),  // removed.csv
};

}  // namespace

std::span<const ObserverKind> observer_kinds() {
  return kinds;
}

Cadence history_cadence(const Scene& scene) {
  return scene.output.history_every ? Cadence(0.0, *scene.output.history_every, scene.start) : Cadence();
}

}  // namespace vitrum
