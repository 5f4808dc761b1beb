#include "scene/read_scene.hpp"

#include <fmt/format.h>

#include "scene/input_text.hpp"
#include "scene/key_depth.hpp"
#include "scene/overrides.hpp"
#include "scene/scene_keys.hpp"
#include "scene/sections.hpp"
#include "scene/toml_text.hpp"

namespace vitrum {
namespace {

toml::table parse_document(std::string_view text, std::string_view name,
                           const std::vector<std::string>& overrides, scene::Diagnostics& diagnostics) {
  toml::table document;
  if (const auto where = scene::find_deep_key(text))
    throw InputError(fmt::format("{}:{}:{}: found a key of more than {} parts, expected the keys of a scene",
                                 name, where->line, where->column, scene::most_key_parts));
  try {
    document = toml::parse(text, name);
  } catch (const toml::parse_error& error) {
    const toml::source_position where = error.source().begin;
    throw InputError(
        scene::single_line(fmt::format("{}:{}:{}: {}", name, where.line, where.column, error.description())));
  }
  for (std::size_t i = 0; i < overrides.size(); ++i)
    scene::apply_override(document, overrides[i], i + 1, diagnostics);
  return document;
}

/// Enters where the keys of a table stand, and those of the tables and lists of tables below.
void note_places(const toml::node& node, const std::string& path, const scene::Diagnostics& diagnostics,
                 std::map<std::string, std::string>& places) {
  if (!path.empty()) places[path] = diagnostics.place(path, node.source().begin);
  if (const toml::table* table = node.as_table())
    for (const auto& [key, value] : *table)
      note_places(value, scene::join_path(path, key.str()), diagnostics, places);
  const toml::array* list = node.as_array();
  for (std::size_t i = 0; list != nullptr && i < list->size() && (*list)[i].is_table(); ++i)
    note_places((*list)[i], scene::join_path(path, i), diagnostics, places);
}

}  // namespace

Scene parse_scene(std::string_view text, std::string_view name, const std::vector<std::string>& overrides) {
  scene::Diagnostics diagnostics{std::string(name)};
  const toml::table table = parse_document(text, name, overrides, diagnostics);
  const scene::TableReader document(table, "", scene::keys::scene(), diagnostics);
  Scene scene;
  scene.verbatim = text;
  scene.overrides = overrides;
  document.read("title", scene.title);
  read_space(document, scene);
  read_time(document, scene);
  read_integrator(document, scene);
  read_constitutive(document, scene.constitutive);
  read_output(document, scene);
  read_gravity(document, scene);
  scene.materials = read_materials(document);
  read_bodies(document, scene);
  read_boundaries(document, scene);
  read_contact(document, scene);
  diagnostics.throw_if_any();
  scene.warnings = diagnostics.warnings();
  note_places(table, "", diagnostics, scene.places);
  return scene;
}

PointScene parse_point(std::string_view text, std::string_view name,
                       const std::vector<std::string>& overrides) {
  scene::Diagnostics diagnostics{std::string(name)};
  const toml::table table = parse_document(text, name, overrides, diagnostics);
  const scene::TableReader document(table, "", scene::keys::point(), diagnostics);
  PointScene point;
  std::vector<MaterialParameters> materials = read_materials(document);
  if (materials.size() > 1)
    document.report("material", fmt::format("found {} materials, expected one", materials.size()));
  if (!materials.empty()) point.material = std::move(materials.front());
  read_constitutive(document, point.constitutive);
  read_state(document, point);
  read_path(document, point);
  diagnostics.throw_if_any();
  point.warnings = diagnostics.warnings();
  return point;
}

Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  const InputText input = read_input(file.string());
  return parse_scene(input.text, input.name, overrides);
}

PointScene read_point(const std::filesystem::path& file, const std::vector<std::string>& overrides) {
  const InputText input = read_input(file.string());
  return parse_point(input.text, input.name, overrides);
}

}  // namespace vitrum
