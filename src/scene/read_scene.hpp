#pragma once
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scene/input_error.hpp"
#include "scene/scene.hpp"

namespace vitrum {

/// Reads and validates a scene file. `overrides` are `--set` arguments, `a.b.c=VALUE`, applied in order
/// before validation; of integrator.step and integrator.courant the one set last replaces the other. Throws
/// InputError with every fault of the file (also when it does not exist), FileError when it cannot be read.
Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});
/// The same for a text; `name` stands for the file in messages.
Scene parse_scene(std::string_view text, std::string_view name,
                  const std::vector<std::string>& overrides = {});

/// The same for a point file (`vitrum point`).
PointScene read_point(const std::filesystem::path& file, const std::vector<std::string>& overrides = {});
PointScene parse_point(std::string_view text, std::string_view name,
                       const std::vector<std::string>& overrides = {});

}  // namespace vitrum
