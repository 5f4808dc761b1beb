#include "scene/read_scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "scene/checks.hpp"
#include "scene/choices.hpp"
#include "scene/input_text.hpp"
#include "scene/key_depth.hpp"
#include "scene/overrides.hpp"
#include "scene/presets.hpp"
#include "scene/read_table.hpp"
#include "scene/scene_tables.hpp"
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
  // Presets are chosen first, so that whatever else is set, or taken away, is that of the chosen ones.
  for (const bool chooses : {true, false}) {
    for (std::size_t i = 0; i < overrides.size(); ++i)
      if (scene::names_preset(overrides[i]) == chooses)
        scene::apply_override(document, overrides[i], i + 1, diagnostics);
    scene::apply_presets(document, diagnostics);
  }
  return document;
}

/// The geometry decides what `fix` of a boundary may name; a wrong one is reported when it is read.
Geometry geometry_of(const toml::table& document) {
  const auto name = document["space"]["geometry"].value<std::string_view>();
  const auto found = std::ranges::find(scene::geometries, name.value_or(""), &scene::Named<Geometry>::name);
  return found != scene::geometries.end() ? found->value : Geometry::axisymmetric;
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
  scene::Formulas formulas(scene::component_names(geometry_of(table)), {},
                           std::filesystem::path(name).parent_path());
  const scene::TableView document(table, "", scene::scene_table(geometry_of(table)), diagnostics, formulas);
  Scene scene;
  scene.verbatim = text;
  scene.overrides = overrides;
  scene::read_table(document, &scene);
  scene.formulas = formulas.used();
  scene.functions = formulas.functions();
  scene.evaluated = scene::check_parameters(document, scene.parameters, scene.evaluated);
  scene::check_methods(document, scene);
  scene::check_materials(document, scene.materials);
  scene::read_images(document, scene);
  scene::check_bodies(document, scene);
  scene::check_boundaries(document, scene);
  scene::check_contact(document, scene);
  scene::check_tractions(document, scene);
  scene::check_probes(document, scene);
  diagnostics.throw_if_any();
  scene.warnings = diagnostics.warnings();
  note_places(table, "", diagnostics, scene.places);
  return scene;
}

PointScene parse_point(std::string_view text, std::string_view name,
                       const std::vector<std::string>& overrides) {
  scene::Diagnostics diagnostics{std::string(name)};
  scene::Formulas formulas(scene::component_names(Geometry::axisymmetric));
  const toml::table table = parse_document(text, name, overrides, diagnostics);
  const scene::TableView document(table, "", scene::point_table(), diagnostics, formulas);
  PointScene point;
  scene::read_table(document, &point);
  point.evaluated = scene::check_parameters(document, point.parameters, point.evaluated);
  if (const std::size_t found = document.tables("material").size(); found > 1)
    document.report("material", fmt::format("found {} materials, expected one", found));
  else if (found == 1)
    scene::check_materials(document, {point.material});
  scene::check_state(document, point);
  scene::check_path(document, point);
  diagnostics.throw_if_any();
  point.state = scene::start_of(point);
  point.formulas = formulas.used();
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
