#pragma once
#include <filesystem>
#include <string>

#include "mpm/computation_error.hpp"
#include "mpm/system.hpp"
#include "scene/scene.hpp"

namespace vitrum::app {

/// The increment that failed as a point file that replays it.
std::string failed_point(const Scene& scene, const System& system, const PointFailure& failure);

}  // namespace vitrum::app
