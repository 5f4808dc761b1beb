#pragma once
#include <filesystem>
#include <memory>
#include <string>
#include <variant>

#include "scene/scene.hpp"

namespace vitrum::scene {

/// A picture, and the SHA-256 of its file.
struct Picture {
  std::shared_ptr<const Greys> greys;
  std::string sha256;
};

/// The grey levels of a PNG file (of colours their luminance, on white where they are transparent), or what
/// is wrong with it. A relative name is looked for in `folder`.
std::variant<Picture, std::string> read_png_greys(const std::filesystem::path& folder,
                                                  const std::string& name);

}  // namespace vitrum::scene
