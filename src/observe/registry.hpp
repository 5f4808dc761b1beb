#pragma once
#include <memory>
#include <span>

#include "observe/observer.hpp"
#include "scene/scene.hpp"

namespace vitrum {

/// An observer as a run finds it.
struct ObserverKind {
  const TableInfo* table;  ///< null: it has none
  /// Makes it for a scene and the system built from it; null where the scene has nothing for it to see.
  std::unique_ptr<Observer> (*make)(const Scene&, const System&);
};

/// All there are, in the order in which they see a step.
std::span<const ObserverKind> observer_kinds();

/// When histories are due: output.history_every.
Cadence history_cadence(const Scene& scene);

}  // namespace vitrum
