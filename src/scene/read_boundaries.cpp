#include <fmt/format.h>

#include <cmath>

#include "scene/boundary_checks.hpp"
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
  boundary.name = table.path();  // "boundary.N"
  if (table.read("name", boundary.name) && (boundary.name.empty() || has_control_characters(boundary.name)))
    table.fail("name", "a name that is not empty, without line breaks or other control characters");
  table.read("moves", boundary.moves);
  table.read("priority", boundary.priority);
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

/// Reports what cannot stand together with the boundaries read before.
void check_against_earlier(const TableReader& table, const BoundaryDefinition& boundary, const Scene& scene) {
  for (const BoundaryDefinition& earlier : scene.boundaries) {
    if (earlier.name == boundary.name) table.fail("name", "a name that no other boundary has");
    const auto when = contradiction(scene, earlier, boundary);
    if (!when) continue;
    table.report(
        "velocity",
        fmt::format("found [{}, {}] m/s for nodes that boundary '{}' holds at [{}, {}] m/s{}; expected "
                    "the same, boxes that have no node in common, or another 'priority' of one of them",
                    number_text(boundary.velocity[0]), number_text(boundary.velocity[1]), earlier.name,
                    number_text(earlier.velocity[0]), number_text(earlier.velocity[1]),
                    *when > scene.start ? fmt::format(" (they meet at t = {:.4g} s)", *when) : ""));
  }
}

}  // namespace

void read_boundaries(const TableReader& document, Scene& scene) {
  for (const TableReader& table : document.tables("boundary", keys::boundary(scene.geometry))) {
    const BoundaryDefinition boundary = read_boundary(table, scene.geometry);
    check_against_earlier(table, boundary, scene);
    scene.boundaries.push_back(boundary);
  }
}

}  // namespace vitrum::scene
