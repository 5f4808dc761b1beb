#include "observe/registry.hpp"

#include "observe/bodies.hpp"
#include "observe/energy_ledger.hpp"
#include "observe/events.hpp"
#include "observe/failure.hpp"
#include "observe/probes.hpp"

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
    kind<EnergyLedger>(), kind<FailureAnalysis>(), kind<EventLog>(),
    kind<BodyHistory>(),  kind<ProbeHistory>(),
};

}  // namespace

std::span<const ObserverKind> observer_kinds() {
  return kinds;
}

Cadence history_cadence(const Scene& scene) {
  return scene.output.history_every ? Cadence(0.0, *scene.output.history_every, scene.start) : Cadence();
}

}  // namespace vitrum
