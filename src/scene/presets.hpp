#pragma once
#include <toml++/toml.h>

#include <string>
#include <string_view>

#include "scene/diagnostics.hpp"

namespace vitrum {
namespace scene {

/// The materials that a scene can name (presets.toml), by name.
const toml::table& presets();

/// Gives each table [material.NAME] that names a preset what it does not give itself, key by key, and takes
/// the name away.
void apply_presets(toml::table& document, Diagnostics& diagnostics);

/// Whether an override (KEY=VALUE) is that of a preset's name.
bool names_preset(std::string_view override_text);

}  // namespace scene

/// The presets with their sources, as Markdown.
std::string materials_page();

}  // namespace vitrum
