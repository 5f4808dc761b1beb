#include "observe/events.hpp"

#include <algorithm>
#include <tuple>

namespace vitrum {
namespace {

constexpr std::size_t patience = std::size_t{1} << 14;  // bytes

}  // namespace

std::unique_ptr<Observer> EventLog::make(const Scene& scene, const System& system) {
  std::array<bool, event_kinds> kinds{};
  for (std::size_t k = 0; k < event_kinds; ++k)
    kinds[k] = !scene.output.events ||
               std::ranges::count(*scene.output.events, event_name(static_cast<EventKind>(k))) > 0;
  return std::make_unique<EventLog>(kinds, system.axisymmetric);
}

EventLog::EventLog(const std::array<bool, event_kinds>& kinds, bool axisymmetric)
    : kinds_(kinds),
      named_(std::to_array(columns)),
      table_({table_info.name, table_info.description, named_}) {
  if (!axisymmetric) named_[4].name = "x", named_[5].name = "y";
  table_.patience = patience;
}

void EventLog::step(const System& system, double duration) {
  // Fractions that differ may be one time: then by body and particle.
  told_.clear();
  for (const BodyEvent& e : system.record.events)
    if (kinds_[static_cast<std::size_t>(e.event.kind)])
      told_.push_back({system.time - duration * (1.0 - e.event.fraction),
                       system.bodies[e.body].particles.identity[e.particle], &e});
  std::ranges::stable_sort(told_, {},
                           [](const Told& t) { return std::tuple(t.time, t.event->body, t.identity); });
  for (const auto& [time, identity, e] : told_) {
    const Body& body = system.bodies[e->body];
    const VectorColumns& position = body.particles.position;
    table_.row(time, body.name, identity, event_name(e->event.kind), position[0][e->particle],
               position[1][e->particle], e->event.stress);
  }
}

}  // namespace vitrum
