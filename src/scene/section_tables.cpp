#include "materials/registry.hpp"
#include "scene/choices.hpp"
#include "scene/scene_tables.hpp"

namespace vitrum::scene {
namespace {

using schema::Field;
using schema::Fields;
using schema::required;
using schema::Table;
using schema::table_of;

/// Whether a scene has the table at all says something, too.
Field<Scene> contact_row() {
  Field<Scene> row("contact", &Scene::contact, contact_table(),
                   "what happens where bodies meet; absent: they share one velocity field");
  row.open = [](void* scene, const std::string&) -> void* {
    ContactDefinition& contact = static_cast<Scene*>(scene)->contact;
    contact.stated = true;
    return &contact;
  };
  row.look = [](const void* scene, std::size_t n) -> const void* {
    const ContactDefinition& contact = static_cast<const Scene*>(scene)->contact;
    return n == 0 && contact.stated ? &contact : nullptr;
  };
  return row;
}

std::vector<std::string> event_names() {
  std::vector<std::string> names;
  for (std::size_t kind = 0; kind < event_kinds; ++kind)
    names.emplace_back(event_name(static_cast<EventKind>(kind)));
  return names;
}

Table make_scene_table(Geometry geometry) {
  return table_of<Scene>(
      "The file", "Tables of the document.",
      {{"title", &Scene::title, "shown in summaries and pictures"},
       {"parameters", &Scene::parameters, "1", intervals::finite,
        "numbers by name, for formulas: wherever a number stands, a text that begins with `=` is one"},
       {"evaluated", &Scene::evaluated,
        "of a resolved scene: parameters (`NAME = VALUE`) whose formulas have become numbers, so that "
        "nothing "
        "changes with them any more"},
       {"space", space_table(), "geometry and grid", required},
       {"time", time_table(), "time span", required},
       {"integrator", &Scene::integrator, integrator_table(), "the grid momentum equations", required},
       {"constitutive", &Scene::constitutive, constitutive_table(), "the local equations of each particle"},
       {"output", &Scene::output, output_table(), "what is written, and when"},
       {"body", &Scene::bodies, body_table(), "the bodies, in order", required},
       {"boundary", &Scene::boundaries, boundary_table(geometry), "grid nodes that are held or driven"},
       contact_row(),
       {"probe", &Scene::probes, probe_table(), "material points whose history goes to `probes.csv`"},
       {"traction", &Scene::tractions, traction_table(), "loads on the surfaces of bodies"},
       {"gravity", gravity_table(), "body force; absent: none"},
       Field<Scene>::named("material", &Scene::materials, material_table(), "the materials", required)});
}

}  // namespace

const Table& scene_table(Geometry geometry) {
  static const Table axisymmetric = make_scene_table(Geometry::axisymmetric),
                     plane_strain = make_scene_table(Geometry::plane_strain);
  return geometry == Geometry::axisymmetric ? axisymmetric : plane_strain;
}

namespace {

/// How velocities go from nodes to particles: by name, or by the share of FLIP.
Field<Scene> transfer_row() {
  static const Table share = schema::in_one_line(table_of<Scene>(
      "`transfer` of [space] as a table", "",
      {{"flip", &Scene::flip, "1", {0.0, 1.0}, "share of FLIP in each step, the rest is PIC", required}}));
  const auto is_text = [](const Scene& scene) { return scene.flip == 1.0 || scene.flip == 0.0; };
  const auto get = [is_text](const Scene& scene) -> std::optional<schema::Value> {
    if (!is_text(scene)) return std::nullopt;
    return std::string(scene.flip == 1.0 ? "flip" : "pic");
  };
  const auto set = [](Scene& scene, const schema::Value& value) {
    scene.flip = std::get<std::string>(value) == "flip" ? 1.0 : 0.0;
  };
  auto row =
      Field<Scene>::of("transfer", {schema::Kind::text},
                       "velocities of particles take the change of the nodes' velocities, or these "
                       "themselves, which is a filter: it takes away, in every step (`arkode-implicit`: "
                       "phase), what nodes do not see, and is booked as `filtered`",
                       schema::Need::optional, get, set)
          .expecting("\"flip\", \"pic\", or a table {flip = SHARE}");
  row.choices = {"flip", "pic"};
  row.table = &share;
  row.open = [](void* scene, const std::string&) { return scene; };
  row.look = [is_text](const void* scene, std::size_t n) {
    return n == 0 && !is_text(*static_cast<const Scene*>(scene)) ? scene : nullptr;
  };
  return row;
}

}  // namespace

const Table& space_table() {
  static const Table table = table_of<Scene>(
      "[space]", "Geometry and grid.",
      {{"geometry", &Scene::geometry, geometries,
        "coordinates (r, z) with the axis at r = 0, or (x, y) with no strain across the plane", required},
       {"cell",
        &Scene::cell,
        "m",
        {1e-140, 1e140},
        "side of the square grid cells; the grid is unbounded",
        required},
       {"shape_functions", &Scene::shape_functions, shape_functions,
        "`linear`: the hat functions of the original method, for bodies that hardly cross cells; `gimp`: "
        "their "
        "averages over the squares that particles were at the start; `cpgimp`: over squares that follow the "
        "particles' stretch, for bodies drawn or pressed by more than a fifth; `bspline2`: quadratic"},
       {"gradients", &Scene::gradients, gradients,
        "velocity gradients between nodes, as in the original method, or between the centroids of what nodes "
        "collect: bodies that turn are not strained"},
       {"filter", &Scene::filter, filters,
        "`pressures`: what particles of a cell store against each other, and nodes do not see, is removed "
        "and booked as `filtered`; for more than one particle a cell"},
       transfer_row()});
  return table;
}

const Table& time_table() {
  static const Table table = table_of<Scene>(
      "[time]", "The time span.",
      {{"start", &Scene::start, "s", intervals::finite, "may be negative, so that t = 0 is first touch"},
       {"end", &Scene::end, "s", intervals::finite, "later than `start`", required}});
  return table;
}

const Table& output_table() {
  using O = OutputDefinition;
  static const Table table = table_of<O>(
      "[output]", "What is written, and when.",
      {{"every", &O::every, "s", intervals::positive,
        "time between outputs, which fall on its multiples, the start and the end; absent: only the last "
        "state"},
       {"fields", &O::fields, output_fields(),
        "particle fields written; absent: all that the scene's models have"},
       {"checkpoint_every", &O::checkpoint_every, "s", intervals::positive,
        "time between checkpoints; absent: none but on a signal"},
       {"history_every", &O::history_every, "s", intervals::positive,
        "time between the rows of histories (`bodies.csv`, ...), each at the first step that ends then or "
        "later; absent: at every output"},
       {"events", &O::events, event_names(), "kinds of events written into `events.csv`; absent: all"}});
  return table;
}

const Table& gravity_table() {
  static const Table table = table_of<Scene>(
      "[gravity]", "",
      {Field<Scene>("acceleration", &Scene::gravity, "m/s^2", intervals::finite, "(r, z) or (x, y)", required)
           .over_time()});
  return table;
}

const std::vector<std::string>& output_fields() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list{"position", "velocity", "stress", "elastic_strain", "damage"};
    for (const Component& column : all_columns())
      if (std::ranges::find(list, column.name) == list.end()) list.push_back(column.name);
    return list;
  }();
  return names;
}

}  // namespace vitrum::scene
