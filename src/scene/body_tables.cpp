#include "scene/choices.hpp"
#include "scene/scene_tables.hpp"

namespace vitrum::schema {

/// A polygon is its vertices.
template <>
struct Codec<Polygon> {
  static Shape shape() { return Codec<std::vector<Vector2>>::shape(); }
  static std::optional<Value> value(const Polygon& polygon) {
    return Codec<std::vector<Vector2>>::value(polygon.vertices);
  }
  static void assign(Polygon& polygon, const Value& value) {
    Codec<std::vector<Vector2>>::assign(polygon.vertices, value);
  }
};

}  // namespace vitrum::schema

namespace vitrum::scene {
namespace {

using schema::Field;
using schema::Fields;
using schema::in_one_line;
using schema::required;
using schema::Table;
using schema::table_of;

Fields<Box> box_rows(const Bounds& bounds) {
  return {{"min", &Box::min, "m", bounds, "lower left corner", required},
          {"max", &Box::max, "m", bounds, "upper right corner", required}};
}

const Table& body_box_table() {
  static const Table table = in_one_line(table_of(
      "Shape `box` of a body", "`min` is less than `max` in both components.", box_rows(intervals::finite)));
  return table;
}

const Table& boundary_box_table() {
  static const Table table =
      in_one_line(table_of("`box` of a boundary", "", box_rows(intervals::infinite_too)));
  return table;
}

const Table& disk_table() {
  static const Table table = in_one_line(table_of<Disk>(
      "Shape `disk` of a body",
      "In axisymmetric geometry a disk centred on the axis is a sphere, any other a torus about it. "
      "Particles at the rim of a disk, a ring or a polygon have the mass of their part of it.",
      {{"centre", &Disk::centre, "m", intervals::finite, "centre", required},
       {"radius", &Disk::radius, "m", intervals::positive, "radius", required}}));
  return table;
}

const Table& ring_table() {
  static const Table table = in_one_line(
      table_of<Ring>("Shape `ring` of a body", "`inner` is less than `outer`.",
                     {{"centre", &Ring::centre, "m", intervals::finite, "centre", required},
                      {"inner", &Ring::inner, "m", intervals::not_negative, "inner radius", required},
                      {"outer", &Ring::outer, "m", intervals::positive, "outer radius", required}}));
  return table;
}

const Table& image_table() {
  static const Table table = in_one_line(table_of<Image>(
      "Shape `image` of a body",
      "The squares of those pixels of a picture whose grey level lies in an interval, for patterns like "
      "crazy "
      "paving: several bodies may take one picture, each other levels. Masses are those of the pixels, "
      "exactly; surfaces are the sides of pixels, so that slopes are stairs.",
      {{"file", &Image::file, "PNG picture beside this file", required},
       {"corner", &Image::corner, "m", intervals::finite, "lower left corner of the picture"},
       {"width", &Image::width, "m", intervals::positive, "of the picture; pixels are squares", required},
       {"grey",
        &Image::grey,
        "1",
        {0.0, 255.0},
        "lowest and highest grey level of the body, both included; 0 is black, 255 white",
        required},
       {"sha256", &Image::sha256,
        "of the picture's file, hexadecimal, as a resolved scene has it: another picture is refused; absent: "
        "any"}}));
  return table;
}

/// One shape, of those that are not made of others.
template <class Owner>
Fields<Owner> shape_rows() {
  return {Field<Owner>::template alternative<Box>("box", &Owner::shape, body_box_table(),
                                                  "shape (exactly one of these)"),
          Field<Owner>::template alternative<Disk>("disk", &Owner::shape, disk_table(), "shape"),
          Field<Owner>::template alternative<Ring>("ring", &Owner::shape, ring_table(),
                                                   "shape: between two circles"),
          Field<Owner>::template alternative<Polygon>("polygon", &Owner::shape, "m", intervals::finite,
                                                      "shape: closed by itself, not self-intersecting")
              .at_least(3)
              .expecting("a list of three or more vertices, each 2 finite numbers (m), or {csv = \"FILE\"}"),
          Field<Owner>::template alternative<Image>("image", &Owner::shape, image_table(),
                                                    "shape: pixels of a picture")};
}
std::vector<std::string> shape_keys(std::size_t count) {
  return {shape_names.begin(), shape_names.begin() + static_cast<std::ptrdiff_t>(count)};
}

const Table& hole_table() {
  static const Table table = [] {
    Table t = in_one_line(table_of<Region>(
        "`hole` of a body", "A shape that is cut out; it may reach beyond the body.", shape_rows<Region>()));
    t.alternatives = {{shape_keys(simple_shapes), "shape"}};
    return t;
  }();
  return table;
}

template <class Owner>
Field<Owner> hole_row() {
  return Field<Owner>("hole", &Owner::holes, hole_table(), "what is cut out of the shape; absent: nothing")
      .expecting("a shape {disk = {..}}, or a list of them");
}

const Table& part_table() {
  static const Table table = [] {
    Fields<Region> rows = shape_rows<Region>();
    rows.push_back(hole_row<Region>());
    Table t = in_one_line(table_of<Region>("Part of a `union` of a body",
                                           "Parts may overlap; what they share counts once.", rows));
    t.alternatives = {{shape_keys(simple_shapes), "shape"}};
    return t;
  }();
  return table;
}

Field<BodyDefinition> union_row() {
  using B = BodyDefinition;
  auto row = Field<B>::alternative<Union>("union", &B::shape, part_table(),
                                          "shape: several together, each with its own holes");
  row.shape = {schema::Kind::tables};
  row.open = [](void* body, const std::string&) -> void* {
    Shape& shape = static_cast<B*>(body)->shape;
    if (!std::holds_alternative<Union>(shape)) shape.emplace<Union>();
    return &std::get<Union>(shape).parts.emplace_back();
  };
  row.look = [](const void* body, std::size_t n) -> const void* {
    const auto* together = std::get_if<Union>(&static_cast<const B*>(body)->shape);
    return together != nullptr && n < together->parts.size() ? &together->parts[n] : nullptr;
  };
  return std::move(row).expecting("a list of shapes [{box = {..}}, {disk = {..}}, ..]");
}

const Table& perturbation_table() {
  static const Table table = in_one_line(table_of<Perturbation>(
      "`perturbation` of a body",
      "Positions alone are displaced; masses and velocities stay those of the places before.",
      {{"amplitude",
        &Perturbation::amplitude,
        "cells",
        {0.0, 0.1},
        "each component of a displacement is uniform between plus and minus this",
        required},
       {"seed", &Perturbation::seed, Bounds{0.0, 1.0e9}, "another seed, other displacements"}}));
  return table;
}

/// `fix`: the components held, by name.
Field<BoundaryDefinition> fix_row(Geometry geometry) {
  using B = BoundaryDefinition;
  const auto names = component_names(geometry);
  const auto get = [names](const B& boundary) {
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < 2; ++i)
      if (boundary.fixed[i]) texts.emplace_back(names[i]);
    return texts;
  };
  const auto set = [names](B& boundary, const schema::Value& value) {
    const auto& texts = std::get<std::vector<std::string>>(value);
    for (std::size_t i = 0; i < 2; ++i) boundary.fixed[i] = std::ranges::find(texts, names[i]) != texts.end();
  };
  auto field = Field<B>::of("fix", {schema::Kind::texts},
                            "velocity components held: \"r\", \"z\", or \"x\", \"y\" in plane strain",
                            required, get, set);
  const auto elsewhere =
      component_names(geometry == Geometry::axisymmetric ? Geometry::plane_strain : Geometry::axisymmetric);
  field.choices.assign(names.begin(), names.end());
  field.choices_elsewhere.assign(elsewhere.begin(), elsewhere.end());
  return field;
}

Table make_boundary_table(Geometry geometry) {
  using B = BoundaryDefinition;
  return table_of<B>(
      "[[boundary]]", "Grid nodes that are held or driven; the axis is handled by the geometry.",
      {Field<B>("name", &B::name,
                "unique; names the boundary in messages; absent: `boundary.N`, counted from 0")
           .derived(),
       {"box", &B::box, boundary_box_table(),
        "acts on the grid nodes inside or on it; sides may be infinite, opposite sides may coincide; deep "
        "boxes that hold one component at 0 have faces that are planes of symmetry",
        required},
       fix_row(geometry),
       Field<B>("velocity", &B::velocity, "m/s", intervals::finite, "value of the held components")
           .over_time(),
       {"moves", &B::moves,
        "the box moves as far as its velocity takes it from `time.start` on, by whole cells; false: it "
        "stays, and what it "
        "holds flows through"},
       {"priority", &B::priority, Bounds{-1000.0, 1000.0},
        "where boundaries hold the same component of a node, the largest acts; different velocities with the "
        "same priority are an error"}});
}

}  // namespace

const Table& traction_box_table() {
  static const Table table =
      in_one_line(table_of("`box` of a traction", "", box_rows(intervals::infinite_too)));
  return table;
}

const Table& probe_box_table() {
  static const Table table = in_one_line(table_of("`box` of a probe", "", box_rows(intervals::finite)));
  return table;
}

const Table& body_table() {
  using B = BodyDefinition;
  static const Table table = [] {
    Fields<B> rows{{"name", &B::name, "unique; names the body in results and messages", required},
                   {"material", &B::material, "NAME of a [material.NAME]", required}};
    const Fields<B> shapes = shape_rows<B>(),
                    others{union_row(),
                           hole_row<B>(),
                           {"particles_per_cell", &B::particles_per_cell, schema::OneOf{{1, 4, 9, 16}},
                            "n x n particles in each cell"},
                           Field<B>("velocity", &B::velocity, "m/s", intervals::finite,
                                    "initial velocity at the origin")
                               .over_place(),
                           {"velocity_gradient", &B::velocity_gradient, "1/s", intervals::finite,
                            "initial velocity = `velocity` + gradient x position"},
                           Field<B>("stress", &B::stress, "Pa", intervals::finite,
                                    "initial stress (rr, zz, tt, rz) or (xx, yy, zz, xy), tension positive")
                               .over_place(),
                           {"relax", &B::relax,
                            "before the start, find the stress nearest to that given which is in equilibrium "
                            "under the loads "
                            "that act then, elastically; nothing moves"},
                           {"perturbation", &B::perturbation, perturbation_table(),
                            "random displacements of the particles, for ensembles; absent: none"}};
    rows.insert(rows.end(), shapes.begin(), shapes.end());
    rows.insert(rows.end(), others.begin(), others.end());
    Table t = table_of<B>("[[body]]", "One table for each body, with exactly one shape.", rows);
    t.alternatives = {{shape_keys(shape_names.size()), "shape"}};
    return t;
  }();
  return table;
}

const Table& boundary_table(Geometry geometry) {
  static const Table axisymmetric = make_boundary_table(Geometry::axisymmetric),
                     plane_strain = make_boundary_table(Geometry::plane_strain);
  return geometry == Geometry::axisymmetric ? axisymmetric : plane_strain;
}

}  // namespace vitrum::scene
