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
                                        "largest principal stress that the event left; at `localisation` the "
                                        "strength"}};
  static constexpr TableInfo table_info{"events", "every event of the local equations, in order of time",
                                        columns};
  static std::unique_ptr<Observer> make(const Scene& scene, const System& system);

  /// kinds: by EventKind, whether it is told.
  EventLog(const std::array<bool, event_kinds>& kinds, bool axisymmetric);

  void step(const System& system, double duration) override;
  Table* table() override { return &table_; }

 private:
  std::array<bool, event_kinds> kinds_;
  std::array<Column, std::size(columns)> named_;  ///< by the scene's geometry
  Table table_;
};

}  // namespace vitrum
