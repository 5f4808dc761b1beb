#include "scene/presets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "scene/scene_tables.hpp"
#include "scene/toml_text.hpp"
#include "vitrum_presets.hpp"

namespace vitrum {
namespace scene {
namespace {

/// The values of a preset, without what tells of them.
toml::table values_of(const toml::node& preset) {
  toml::table values = *preset.as_table();
  for (const char* key : {"text", "source"}) values.erase(key);
  return values;
}

/// Adds to `table`, at `path`, what `preset` has besides. origin: the key that names the preset.
void fill(toml::table& table, const toml::table& preset, const std::string& path,
          const Diagnostics::Origin& origin, Diagnostics& diagnostics) {
  for (const auto& [key, value] : preset) {
    const std::string below = join_path(path, key.str());
    toml::node* given = table.get(key.str());
    if (given == nullptr) {
      table.insert(key.str(), value);
      diagnostics.note_origin(below, origin);
    } else if (given->is_table() && value.is_table()) {
      fill(*given->as_table(), *value.as_table(), below, origin, diagnostics);
    }
  }
}

}  // namespace

const toml::table& presets() {
  static const toml::table all = toml::parse(presets_text);
  return all;
}

bool names_preset(std::string_view text) {
  std::string_view key = text.substr(0, text.find('='));
  while (key.ends_with(' ')) key.remove_suffix(1);
  return key.starts_with("material.") && key.ends_with(".preset");
}

void apply_presets(toml::table& document, Diagnostics& diagnostics) {
  toml::table* materials = document["material"].as_table();
  if (materials == nullptr) return;
  for (auto&& [name, node] : *materials) {
    toml::table* material = node.as_table();
    const toml::node* named = material == nullptr ? nullptr : material->get("preset");
    if (named == nullptr) continue;
    const std::string path = join_path("material", name.str()), wanted = named->value_or(std::string());
    const toml::node* preset = presets().get(wanted);
    if (preset == nullptr) continue;  // whoever reads the table reports it
    const Diagnostics::Origin origin{join_path(path, "preset"), named->source().begin};
    material->erase("preset");
    fill(*material, values_of(*preset), path, origin, diagnostics);
  }
}

}  // namespace scene

namespace {

/// A value, and a table as its keys.
std::string value_cell(const toml::node& node) {
  if (const auto number = node.value<double>()) return fmt::format("{:g}", *number);
  if (const auto text = node.value<std::string_view>()) return scene::toml_quoted(*text);
  std::string list;
  if (const toml::array* items = node.as_array())
    for (const toml::node& item : *items) list += (list.empty() ? "" : ", ") + value_cell(item);
  return '[' + list + ']';
}

/// schema: of the table; what a preset says has been read by it.
void add_rows(std::string& text, const toml::table& table, const schema::Table& schema,
              const std::string& path) {
  for (const auto& [name, value] : table) {
    const std::string below = scene::join_path(path, name.str());
    const schema::Key& key = *schema.find(name.str());
    if (const toml::table* keys = value.as_table())
      add_rows(text, *keys, *key.table, below);
    else
      text += fmt::format("| `{}` | {} | {} | {} |\n", below, value_cell(value),
                          key.shape.kind == schema::Kind::text ? "" : key.unit, key.text);
  }
}

}  // namespace

std::string materials_page() {
  std::string text = R"(# Materials

Presets: `[material.NAME]` with `preset = ".."` has the values below, each unless the scene gives its own (`preset = "copper"` and `young = 120e9`;
`[material.NAME.johnson_cook]` and `temperature = 400.0`). `check` prints the scene with all of them filled in. Bounds and defaults are in the
[scene reference](scene.md), the laws are in the [theory](../theory/other-laws.md). Published constants are fits to some batch of a material under some loading:
read the source before a conclusion depends on them.
The paper is *A Rate-Dependent Damage/Decohesion Model for Simulating Glass Fragmentation under Impact using the Material Point Method*.

This page is printed by the program from the table that its reader uses (`vitrum reference --materials`); do not edit it.
)";
  for (const auto& [name, preset] : scene::presets()) {
    const toml::table& table = *preset.as_table();
    text += fmt::format("\n## `{}`\n\n{}.\n\n| key | value | unit | meaning |\n|---|---|---|---|\n",
                        name.str(), table["text"].value_or(std::string_view()));
    add_rows(text, scene::values_of(preset), scene::material_table(), "");
    text += "\nSources:\n\n";
    for (const auto& [key, source] : *table["source"].as_table())
      text += fmt::format("- `{}`: {}.\n", key.str(), source.value_or(std::string_view()));
  }
  return text;
}

}  // namespace vitrum
