#pragma once
#include <functional>

#include "materials/law.hpp"
#include "scene/scene.hpp"

namespace vitrum::app {

/// Told what happens along a strain path: the state at its start and after each sample, and the events
/// between.
struct PathListener {
  std::function<void(double time, const SymmetricTensor& strain, const PointState& state)> row;
  std::function<void(EventKind kind, double time)> event;
};

/// Drives a material point along the strain path of a point file. Throws ComputationError, which names the
/// time, when an increment cannot be integrated or leaves a state that is not finite.
void follow_path(const PointScene& scene, const Material& material, const PathListener& listener);

}  // namespace vitrum::app
