#include <fmt/format.h>

#include <cmath>

#include "scene/boundary_checks.hpp"
#include "scene/checks.hpp"
#include "scene/choices.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::scene {
namespace {

/// Sides that coincide select a line of nodes; an interval that lies at infinity selects nothing.
bool selects_nodes(double lowest, double highest) {
  return lowest < highest || (lowest == highest && std::isfinite(lowest));
}

void check_box(const TableView& table, const Box& box) {
  if (!selects_nodes(box.min[0], box.max[0]) || !selects_nodes(box.min[1], box.max[1]))
    table.report("max",
                 fmt::format("found [{}, {}], expected no component less than that of 'min' ([{}, {}])",
                             number_text(box.max[0]), number_text(box.max[1]), number_text(box.min[0]),
                             number_text(box.min[1])));
}

void check_boundary(const TableView& table, const BoundaryDefinition& boundary, const Scene& scene) {
  const Geometry geometry = scene.geometry;
  if (table.sound("name")) check_name(table, boundary.name);
  if (const auto box = table.table("box"); box && table.sound("box")) check_box(*box, boundary.box);
  if (!table.sound("fix")) return;
  if (!boundary.fixed[0] && !boundary.fixed[1]) return table.fail("fix", table.expected("fix"));
  for (std::size_t i = 0; i < 2; ++i)
    if (const bool varies = scene.varies(fmt::format("{}.velocity.{}", table.path(), i));
        (boundary.velocity[i] != 0.0 || varies) && !boundary.fixed[i])
      table.report("velocity", fmt::format("found {} for component \"{}\", expected 0 or \"{}\" in 'fix'",
                                           varies ? "a function" : number_text(boundary.velocity[i]),
                                           component_names(geometry)[i], component_names(geometry)[i]));
}

/// Reports what cannot stand together with an earlier boundary.
void check_against(const TableView& table, const BoundaryDefinition& boundary,
                   const BoundaryDefinition& earlier, const Scene& scene) {
  if (earlier.name == boundary.name) table.fail("name", "a name that no other boundary has");
  const auto when = contradiction(scene, earlier, boundary);
  if (!when) return;
  table.report(
      "velocity",
      fmt::format("found [{}, {}] m/s for nodes that boundary '{}' holds at [{}, {}] m/s{}; expected "
                  "the same, boxes that have no node in common, or another 'priority' of one of them",
                  number_text(boundary.velocity[0]), number_text(boundary.velocity[1]), earlier.name,
                  number_text(earlier.velocity[0]), number_text(earlier.velocity[1]),
                  *when > scene.start ? fmt::format(" (they meet at t = {:.4g} s)", *when) : ""));
}

}  // namespace

void check_boundaries(const TableView& document, Scene& scene) {
  const std::vector<TableView> tables = document.tables("boundary");
  for (std::size_t i = 0; i < tables.size(); ++i) {
    BoundaryDefinition& boundary = scene.boundaries[i];
    if (!tables[i].has("name")) boundary.name = tables[i].path();  // "boundary.N"
    check_boundary(tables[i], boundary, scene);
    for (std::size_t j = 0; j < i; ++j) check_against(tables[i], boundary, scene.boundaries[j], scene);
  }
}

}  // namespace vitrum::scene
