#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <variant>

#include "scene/scene.hpp"

namespace vitrum::scene {

/// The grey levels of a PNG file (of colours their luminance, on white where they are transparent), or what
/// is wrong with it. A relative name is looked for in `folder`.
std::variant<std::shared_ptr<const Greys>, std::string> read_png_greys(const std::filesystem::path& folder,
                                                                       const std::string& name);

}  // namespace vitrum::scene
