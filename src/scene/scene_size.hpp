#pragma once
#include <vector>

#include "scene/scene.hpp"

namespace vitrum {

/// What a scene asks of a machine, from its shapes alone: nothing is made, so that a size without sense costs
/// nothing.
struct SceneSize {
  std::vector<double> particles;  ///< by body
  double all_particles = 0.0;
  double cells = 0.0;          ///< of the grid that hold particles at the start
  double memory = 0.0;         ///< bytes, at the peak of a run whose bodies stay together
  double factor_memory = 0.0;  ///< bytes, the part of a factorised matrix (arkode-implicit)
};

SceneSize size_of(const Scene& scene);

}  // namespace vitrum
