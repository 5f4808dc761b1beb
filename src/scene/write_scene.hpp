#pragma once
#include <string>

#include "scene/scene.hpp"

namespace vitrum {

/// The scene as TOML with every default filled in. parse_scene reads it back to an equal scene (numbers bit
/// for bit), apart from `verbatim` and `overrides`. Keys whose absence means something (output.every, ...)
/// stay absent.
std::string resolved_toml(const Scene& scene);

/// A point file with every default filled in; parse_point reads it back.
std::string point_toml(const PointScene& point);

}  // namespace vitrum
