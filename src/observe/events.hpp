#pragma once
#include <array>

#include "observe/observer.hpp"
#include "scene/scene.hpp"

namespace vitrum {

/// Fills events.csv: every event of the local equations (yield, damage, localisation, ...), located within
/// its step, in order of time. Place: the particle's at the end of the step (of the phase's start in
/// Lagrangian phases). "first ..." and fronts are queries on it.
class EventLog final : public Observer {
 public:
  static constexpr Column columns[] = {{"time", "s", "of the event, located within its step"},
                                       {"body", "", "name"},
                                       {"particle", "1", "number of the particle in its body, from 0"},
                                       {"kind", "", "what happened: `damage`, `yield`, ..."},
                                       {"r", "m", "place of the particle (`x` in plane strain)"},
                                       {"z", "m", "(`y` in plane strain)"},
                                       {"value", "Pa",
                                        "largest principal stress then, hoop direction included; after the "
                                        "jump of an event that is one"}};
  static constexpr TableInfo table_info{
      "events",
      "every event of the local equations, in order of time, body and particle. A point at the edge of two "
      "modes may yield or close many times in next to no time, and does so differently under each local "
      "method",
      columns};
  static std::unique_ptr<Observer> make(const Scene& scene, const System& system);

  /// kinds: by EventKind, whether it is told.
  EventLog(const std::array<bool, event_kinds>& kinds, bool axisymmetric);

  void step(const System& system, double duration) override;
  Table* table() override { return &table_; }

 private:
  /// An event with its time, and the number of its particle in its body.
  struct Told {
    double time;
    std::uint32_t identity;
    const BodyEvent* event;
  };

  std::array<bool, event_kinds> kinds_;
  std::vector<Told> told_;                        ///< of a step
  std::array<Column, std::size(columns)> named_;  ///< by the scene's geometry
  Table table_;
};

}  // namespace vitrum
