#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include "scene/checks.hpp"
#include "scene/choices.hpp"
#include "scene/input_error.hpp"
#include "scene/outline.hpp"
#include "scene/polygon_check.hpp"
#include "scene/shape_measures.hpp"
#include "scene/shapes.hpp"
#include "scene/suggestion.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::scene {
namespace {

void check_box(const TableView& table, const Box& box) {
  if (box.min[0] < box.max[0] && box.min[1] < box.max[1]) return;
  table.report("max",
               fmt::format("found [{}, {}], expected both components greater than those of 'min' ([{}, {}])",
                           number_text(box.max[0]), number_text(box.max[1]), number_text(box.min[0]),
                           number_text(box.min[1])));
}

void check_ring(const TableView& table, const Ring& ring) {
  if (!(ring.inner < ring.outer))
    table.fail("outer", fmt::format("a radius greater than 'inner' ({})", number_text(ring.inner)));
}

void check_polygon(const TableView& body, const Polygon& polygon) {
  constexpr std::size_t most_vertices = 10'000;  // each edge is compared with each other
  if (polygon.vertices.size() > most_vertices)
    return body.fail("polygon", fmt::format("at most {} vertices", most_vertices));
  const std::string fault = polygon_fault(polygon.vertices);
  if (fault.empty()) return;
  body.report(
      "polygon",
      fmt::format("found {}, expected three or more vertices of a closed line that does not meet itself "
                  "(the last vertex joins the first)",
                  fault));
}

void check_image(const TableView& table, const Image& image) {
  if (!(image.grey[0] <= image.grey[1]))
    return table.fail("grey", "the lowest level, then one that is not less");
  const auto [least, most] = std::ranges::minmax(image.greys->levels);
  const auto within = [&](unsigned char level) { return level >= image.grey[0] && level <= image.grey[1]; };
  if (std::ranges::none_of(image.greys->levels, within))
    table.report("grey",
                 fmt::format("found no pixel of such a level in '{}', expected some (they are from {} to {})",
                             image.file, least, most));
}

void check_shape(const TableView& body, const Shape& shape) {
  if (const auto* box = std::get_if<Box>(&shape)) check_box(*body.table("box"), *box);
  if (const auto* ring = std::get_if<Ring>(&shape)) check_ring(*body.table("ring"), *ring);
  if (const auto* polygon = std::get_if<Polygon>(&shape)) check_polygon(body, *polygon);
  if (const auto* image = std::get_if<Image>(&shape)) check_image(*body.table("image"), *image);
}

double least_radius(const Shape& shape) {
  if (const auto* box = std::get_if<Box>(&shape)) return box->min[0];
  if (const auto* disk = std::get_if<Disk>(&shape)) return disk->centre[0];
  if (const auto* ring = std::get_if<Ring>(&shape)) return ring->centre[0];
  if (const auto* image = std::get_if<Image>(&shape)) return image->corner[0];
  const auto& vertices = std::get<Polygon>(shape).vertices;
  return std::ranges::min(vertices, {}, [](const Vector2& v) { return v[0]; })[0];
}

/// Round bodies may reach over the axis: a sphere is a disk centred on it, of which the half r > 0 is meant.
void check_axis(const TableView& body, const Shape& shape) {
  if (least_radius(shape) >= 0.0) return;
  const std::string_view name = shape_names[shape.index()];
  const bool round = name == "disk" || name == "ring";
  body.report(name, fmt::format("found {} r = {}, expected r >= 0 in axisymmetric geometry",
                                round ? "a centre at" : "a corner at", number_text(least_radius(shape))));
}

void check_material(const TableView& body, const BodyDefinition& definition, const Scene& scene) {
  std::vector<std::string> names;
  for (const MaterialParameters& material : scene.materials) names.push_back(material.name);
  if (std::ranges::find(names, definition.material) != names.end()) return;
  const std::string known = names.empty() ? "the name of a [material.NAME]"
                                          : "a material of this file: " + schema::quoted_list(names);
  body.fail("material", with_suggestion(known, definition.material, names));
}

/// Where bodies overlap, mass would count twice and stress be without a state of rest.
void check_overlap(const TableView& table, const BodyDefinition& body, const BodyDefinition& other,
                   double cell) {
  if (!(cell > 0.0)) return;  // reported
  const double spacing = cell / std::sqrt(body.particles_per_cell);
  const auto common = common_point(body, other, 0.5 * spacing, 1e-6 * spacing);
  if (!common) return;
  table.report(
      shape_names[body.shape.index()],
      fmt::format("found it overlapping body '{}' at ({:.6g}, {:.6g}) m, expected bodies that at most touch",
                  other.name, (*common)[0], (*common)[1]));
}

/// Whether a body, or a part of it, has one shape, and nothing has been reported of it or its holes.
bool has_shape(const TableView& table, const Region& body) {
  const auto given = std::ranges::count_if(shape_names, [&](std::string_view key) { return table.has(key); });
  const std::string_view key = shape_names[body.shape.index()];
  return given == 1 && table.has(key) && table.sound(key) && table.sound("hole");
}

/// m^2; NaN where edges of the region's shapes have too much in common.
double area_of(const Region& region) {
  if (const auto* together = std::get_if<Union>(&region.shape); together && together->parts.empty())
    return 0.0;
  try {
    return measures(region, Geometry::plane_strain).area;
  } catch (const InputError&) {
    return std::numeric_limits<double>::quiet_NaN();
  }
}

/// The parts or holes of a region. What one of them changes, it changes in its own box, where others are few.
class Pieces {
 public:
  explicit Pieces(const std::vector<Region>& regions) : regions_(regions), idle_(regions.size()) {
    for (const Region& each : regions) boxes_.push_back(bounds(each));
  }
  const Box& box(std::size_t n) const { return boxes_[n]; }
  void set_idle(std::size_t n) { idle_[n] = true; }

  /// Those at a box, without one, and without those that are idle.
  std::vector<Region> at(const Box& box, std::size_t but = std::numeric_limits<std::size_t>::max()) const {
    std::vector<Region> list;
    for (std::size_t n = 0; n < boxes_.size(); ++n)
      if (n != but && !idle_[n] && boxes_[n].min[0] <= box.max[0] && box.min[0] <= boxes_[n].max[0] &&
          boxes_[n].min[1] <= box.max[1] && box.min[1] <= boxes_[n].max[1])
        list.push_back(regions_[n]);
    return list;
  }

 private:
  const std::vector<Region>& regions_;
  std::vector<Box> boxes_;
  std::vector<bool> idle_;
};

/// Whether a piece (of an area, uncut) changes nothing of a region's area, to what edges and areas are known.
/// Of what is too small beside the region, nobody can say.
bool changes_nothing(double piece, double without, double with) {
  constexpr double known = 1e-9, rounding = 1e-13;
  return piece > 100.0 * rounding * without &&
         std::abs(with - without) <= std::max(known * piece, rounding * without);
}

/// Parts of a region that change nothing. Of two that are the same the second is told.
void judge_parts(const TableView& table, const std::vector<Region>& parts, const std::vector<Region>& holes) {
  const std::vector<TableView> tables = table.tables("union");
  Pieces pieces(parts);
  const Pieces cut(holes);
  for (std::size_t n = parts.size(); n-- > 0;) {
    Region without = Union{pieces.at(pieces.box(n), n)};
    without.holes = cut.at(pieces.box(n));
    Region with = without;
    std::get<Union>(with.shape).parts.push_back(parts[n]);
    if (!changes_nothing(area_of(Region(parts[n].shape)), area_of(without), area_of(with))) continue;
    pieces.set_idle(n);
    tables[n].warn(shape_names[parts[n].shape.index()],
                   "found it adding nothing, expected something that neither the other parts have nor holes "
                   "cut out");
  }
}

/// Holes that cut nothing out, or what the grid does not know. Of two that are the same the second is told.
void judge_holes(const TableView& table, const Region& region, double cell) {
  const std::vector<TableView> tables = table.tables("hole");
  if (tables.empty()) return;
  const auto* together = std::get_if<Union>(&region.shape);
  const std::vector<Region> none;
  const Pieces parts(together ? together->parts : none);
  Pieces holes(region.holes);
  const double whole = together ? 0.0 : area_of(Region(region.shape));
  for (std::size_t n = tables.size(); n-- > 0;) {
    const Region& hole = region.holes[n];
    const Box& box = holes.box(n);
    const Region body = together ? Region(Union{parts.at(box)}) : Region(region.shape);
    const double area = area_of(Region(hole.shape)), uncut = together ? area_of(body) : whole;
    const auto left_by = [&](std::vector<Region> list) {
      Region rest = body;
      rest.holes = std::move(list);
      return rest.holes.empty() ? uncut : area_of(rest);
    };
    std::vector<Region> others = holes.at(box, n);
    const double without = left_by(others);
    others.push_back(hole);
    const std::string_view key = shape_names[hole.shape.index()];
    const double width = std::min(box.max[0] - box.min[0], box.max[1] - box.min[1]);
    if (changes_nothing(area, without, left_by(others))) {
      holes.set_idle(n);
      const bool outside = changes_nothing(area, uncut, left_by({hole}));
      tables[n].warn(key, outside ? fmt::format("found it outside '{}', expected it to cut something out",
                                                join_path(table.path(), shape_names[region.shape.index()]))
                                  : "found it within other holes, expected it to cut something out");
    } else if (width < cell) {
      tables[n].warn(key,
                     fmt::format("found it {:.3g} m wide, less than a cell ({:.3g} m): it takes mass away, "
                                 "but what is beside it moves as if it were not there",
                                 width, cell));
    }
  }
}

void check_region(const TableView& table, const Region& region, const Scene& scene) {
  const bool axisymmetric = scene.geometry == Geometry::axisymmetric;
  if (!has_shape(table, region)) return;
  if (const auto* together = std::get_if<Union>(&region.shape)) {
    const std::vector<TableView> parts = table.tables("union");
    for (std::size_t n = 0; n < parts.size(); ++n) check_region(parts[n], together->parts[n], scene);
  } else {
    check_shape(table, region.shape);
    if (axisymmetric) check_axis(table, region.shape);
  }
  if (table.schema().find("hole") == nullptr) return;
  const std::vector<TableView> holes = table.tables("hole");
  for (std::size_t n = 0; n < holes.size(); ++n)
    if (has_shape(holes[n], region.holes[n])) check_shape(holes[n], region.holes[n].shape);
  if (!is_composed(region) || !has_shape(table, region)) return;
  try {
    outline(region);
    if (const auto* together = std::get_if<Union>(&region.shape))
      judge_parts(table, together->parts, region.holes);
    judge_holes(table, region, scene.cell);
  } catch (const InputError& error) {
    table.report(shape_names[region.shape.index()], error.what());
  }
}

void check_body(const TableView& table, const BodyDefinition& body, const Scene& scene) {
  if (table.sound("name")) check_name(table, body.name);
  if (table.sound("material")) check_material(table, body, scene);
  check_region(table, body, scene);
}

}  // namespace

void check_name(const TableView& table, std::string_view name) {
  if (name.empty() || has_control_characters(name))
    table.fail("name", "a name that is not empty, without line breaks or other control characters");
}

void check_bodies(const TableView& document, const Scene& scene) {
  const std::vector<TableView> tables = document.tables("body");
  std::map<std::string, std::string> paths;
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const BodyDefinition& body = scene.bodies[i];
    check_body(tables[i], body, scene);
    for (std::size_t j = 0; j < i && has_shape(tables[i], body); ++j)
      if (has_shape(tables[j], scene.bodies[j])) check_overlap(tables[i], body, scene.bodies[j], scene.cell);
    const auto [first, is_new] = paths.emplace(body.name, tables[i].path());
    if (!is_new && !body.name.empty())
      tables[i].fail("name", fmt::format("a name of its own ('{}' has this one)", first->second));
  }
}

}  // namespace vitrum::scene
