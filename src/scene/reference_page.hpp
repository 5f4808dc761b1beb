#pragma once
#include <string>

namespace vitrum {

/// docs/reference/scene.md: every key of scene and point files, from the tables that the reader itself uses.
std::string scene_reference();

/// JSON schemas of scene and point files, from the same tables.
std::string scene_schema();
std::string point_schema();

}  // namespace vitrum
