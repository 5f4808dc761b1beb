#include <fmt/format.h>

#include <cmath>

#include "scene/choices.hpp"
#include "scene/scene_keys.hpp"
#include "scene/sections.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::scene {
namespace {

/// Sides that coincide select a line of nodes; an interval that lies at infinity selects nothing.
bool selects_nodes(double lowest, double highest) {
  return lowest < highest || (lowest == highest && std::isfinite(lowest));
}

void read_box(const TableReader& boundary, Box& box) {
  const auto table = boundary.table("box", keys::boundary_box());
  if (!table) return;
  const bool has_min = table->read("min", box.min);
  if (!table->read("max", box.max) || !has_min) return;
  if (!selects_nodes(box.min[0], box.max[0]) || !selects_nodes(box.min[1], box.max[1]))
    table->report("max",
                  fmt::format("found [{}, {}], expected no component less than that of 'min' ([{}, {}])",
                              number_text(box.max[0]), number_text(box.max[1]), number_text(box.min[0]),
                              number_text(box.min[1])));
}

bool read_fixed(const TableReader& boundary, Geometry geometry, std::array<bool, 2>& fixed) {
  std::vector<std::string> names;
  if (!boundary.read("fix", names)) return false;
  if (names.empty()) boundary.fail("fix", find_key(keys::boundary(geometry), "fix").expected);
  for (const std::string& name : names) fixed[name == component_names(geometry)[1] ? 1 : 0] = true;
  return !names.empty();
}

BoundaryDefinition read_boundary(const TableReader& table, Geometry geometry) {
  BoundaryDefinition boundary{};
  read_box(table, boundary.box);
  const bool fixes = read_fixed(table, geometry, boundary.fixed);
  if (!table.read("velocity", boundary.velocity) || !fixes) return boundary;
  for (std::size_t i = 0; i < 2; ++i)
    if (boundary.velocity[i] != 0.0 && !boundary.fixed[i])
      table.report("velocity", fmt::format("found {} for component \"{}\", expected 0 or \"{}\" in 'fix'",
                                           number_text(boundary.velocity[i]), component_names(geometry)[i],
                                           component_names(geometry)[i]));
  return boundary;
}

}  // namespace

void read_boundaries(const TableReader& document, Scene& scene) {
  for (const TableReader& table : document.tables("boundary", keys::boundary(scene.geometry)))
    scene.boundaries.push_back(read_boundary(table, scene.geometry));
}

}  // namespace vitrum::scene
