#pragma once
#include "mpm/system.hpp"
#include "scene/scene.hpp"

namespace vitrum {

/// Threads that the machine offers, at least 1.
int available_threads();

/// Threads worth using for a scene that runs alone, at most `available`: where a step is short, threads lose
/// more to waiting for each other than they gain. Depends on how many particles there are and on what their
/// models and shape functions cost, not on how far the scene has come.
int thread_count(const Scene& scene, const System& system, int available);

}  // namespace vitrum
