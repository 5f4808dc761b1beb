#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "scene/choices.hpp"
#include "scene/polygon_check.hpp"
#include "scene/scene_keys.hpp"
#include "scene/sections.hpp"
#include "scene/shapes.hpp"
#include "scene/suggestion.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::scene {
namespace {

std::optional<Shape> read_body_box(const TableReader& body) {
  const auto table = body.table("box", keys::box());
  Box box{};
  if (!table || !table->read("min", box.min)) return std::nullopt;
  if (!table->read("max", box.max)) return std::nullopt;
  if (box.min[0] < box.max[0] && box.min[1] < box.max[1]) return box;
  table->report("max",
                fmt::format("found [{}, {}], expected both components greater than those of 'min' ([{}, {}])",
                            number_text(box.max[0]), number_text(box.max[1]), number_text(box.min[0]),
                            number_text(box.min[1])));
  return std::nullopt;
}

std::optional<Shape> read_disk(const TableReader& body) {
  const auto table = body.table("disk", keys::disk());
  Disk disk{};
  if (!table) return std::nullopt;
  const bool centre = table->read("centre", disk.centre), radius = table->read("radius", disk.radius);
  return centre && radius ? std::optional<Shape>(disk) : std::nullopt;
}

std::optional<Shape> read_ring(const TableReader& body) {
  const auto table = body.table("ring", keys::ring());
  Ring ring{};
  if (!table) return std::nullopt;
  const bool centre = table->read("centre", ring.centre), inner = table->read("inner", ring.inner);
  if (!table->read("outer", ring.outer) || !inner) return std::nullopt;
  if (!(ring.inner < ring.outer)) {
    table->fail("outer", fmt::format("a radius greater than 'inner' ({})", number_text(ring.inner)));
    return std::nullopt;
  }
  return centre ? std::optional<Shape>(ring) : std::nullopt;
}

std::optional<Shape> read_polygon(const TableReader& body) {
  std::vector<std::vector<double>> rows;
  if (!body.read_rows("polygon", 2, rows)) return std::nullopt;
  constexpr std::size_t most_vertices = 10'000;  // each edge is compared with each other
  if (rows.size() > most_vertices) {
    body.fail("polygon", fmt::format("at most {} vertices", most_vertices));
    return std::nullopt;
  }
  Polygon polygon;
  for (const std::vector<double>& row : rows) polygon.vertices.push_back({row[0], row[1]});
  const std::string fault = polygon_fault(polygon.vertices);
  if (fault.empty()) return polygon;
  body.report(
      "polygon",
      fmt::format("found {}, expected three or more vertices of a closed line that does not meet itself "
                  "(the last vertex joins the first)",
                  fault));
  return std::nullopt;
}

std::optional<Shape> read_shape(const TableReader& body) {
  std::vector<std::string> given;
  for (const std::string_view name : shape_names)
    if (body.has(name)) given.emplace_back(name);
  if (given.size() != 1) {
    const std::string found = given.empty() ? "no shape" : quoted_list(given);
    body.report(fmt::format("found {}, expected exactly one of box, disk, ring, polygon", found));
  }
  const std::array<std::optional<Shape>, 4> shapes{read_body_box(body), read_disk(body), read_ring(body),
                                                   read_polygon(body)};
  const auto valid = std::ranges::find_if(shapes, [](const auto& shape) { return shape.has_value(); });
  return given.size() == 1 && valid != shapes.end() ? *valid : std::nullopt;
}

double least_radius(const Shape& shape) {
  if (const auto* box = std::get_if<Box>(&shape)) return box->min[0];
  if (const auto* disk = std::get_if<Disk>(&shape)) return disk->centre[0];
  if (const auto* ring = std::get_if<Ring>(&shape)) return ring->centre[0];
  const auto& vertices = std::get<Polygon>(shape).vertices;
  return std::ranges::min(vertices, {}, [](const Vector2& v) { return v[0]; })[0];
}

/// Round bodies may reach over the axis: a sphere is a disk centred on it, of which the half r > 0 is meant.
void check_axis(const TableReader& body, const Shape& shape) {
  if (least_radius(shape) >= 0.0) return;
  const std::string_view name = shape_names[shape.index()];
  const bool round = name == "disk" || name == "ring";
  body.report(name, fmt::format("found {} r = {}, expected r >= 0 in axisymmetric geometry",
                                round ? "a centre at" : "a corner at", number_text(least_radius(shape))));
}

void read_particles_per_cell(const TableReader& body, int& count) {
  if (body.read("particles_per_cell", count) && count != 1 && count != 4 && count != 9 && count != 16)
    body.fail("particles_per_cell", "1, 4, 9 or 16");
}

void read_velocity_gradient(const TableReader& body, std::array<Vector2, 2>& gradient) {
  std::vector<std::vector<double>> rows;
  if (!body.read_rows("velocity_gradient", 2, rows)) return;
  if (rows.size() != 2)
    return body.fail("velocity_gradient", find_key(keys::body(), "velocity_gradient").expected);
  gradient = {Vector2{rows[0][0], rows[0][1]}, Vector2{rows[1][0], rows[1][1]}};
}

void read_perturbation(const TableReader& body, Perturbation& perturbation) {
  const auto table = body.table("perturbation", keys::perturbation());
  if (!table) return;
  table->read("amplitude", perturbation.amplitude);
  table->read("seed", perturbation.seed);
}

void check_material(const TableReader& body, const BodyDefinition& definition, const Scene& scene) {
  std::vector<std::string> names;
  for (const MaterialParameters& material : scene.materials) names.push_back(material.name);
  if (std::ranges::find(names, definition.material) != names.end()) return;
  const std::string known =
      names.empty() ? "the name of a [material.NAME]" : "a material of this file: " + quoted_list(names);
  body.fail("material", with_suggestion(known, definition.material, names));
}

/// Where bodies overlap, mass would count twice and stress be without a state of rest.
void check_overlap(const TableReader& table, const BodyDefinition& body, const Scene& scene) {
  if (!(scene.cell > 0.0) || body.particles_per_cell < 1) return;  // reported
  const double spacing = scene.cell / std::sqrt(body.particles_per_cell);
  for (const BodyDefinition& other : scene.bodies) {
    const auto common = common_point(body.shape, other.shape, 0.5 * spacing, 1e-6 * spacing);
    if (!common) continue;
    const std::size_t shape = body.shape.index();
    table.report(
        shape_names[shape],
        fmt::format(
            "found it overlapping body '{}' at ({:.6g}, {:.6g}) m, expected bodies that at most touch",
            other.name, (*common)[0], (*common)[1]));
  }
}

BodyDefinition read_body(const TableReader& table, const Scene& scene) {
  BodyDefinition body;
  if (table.read("name", body.name) && (body.name.empty() || has_control_characters(body.name)))
    table.fail("name", "a name that is not empty, without line breaks or other control characters");
  if (table.read("material", body.material)) check_material(table, body, scene);
  const auto shape = read_shape(table);
  if (shape) {
    body.shape = *shape;
    if (scene.geometry == Geometry::axisymmetric) check_axis(table, *shape);
  }
  read_particles_per_cell(table, body.particles_per_cell);
  if (shape) check_overlap(table, body, scene);
  table.read("velocity", body.velocity);
  read_velocity_gradient(table, body.velocity_gradient);
  table.read("stress", body.stress);
  read_perturbation(table, body.perturbation);
  return body;
}

}  // namespace

void read_bodies(const TableReader& document, Scene& scene) {
  const std::vector<TableReader> tables = document.tables("body", keys::body());
  const toml::node* node = document.toml().get("body");
  if (node != nullptr && node->is_array() && node->as_array()->empty())
    document.fail("body", find_key(keys::scene(), "body").expected);
  std::map<std::string, std::string> paths;
  for (const TableReader& table : tables) {
    scene.bodies.push_back(read_body(table, scene));
    const std::string& name = scene.bodies.back().name;
    const auto [first, is_new] = paths.emplace(name, table.path());
    if (!is_new && !name.empty())
      table.fail("name", fmt::format("a name of its own ('{}' has this one)", first->second));
  }
}

}  // namespace vitrum::scene
