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

/// Below, the rounding of one step's sums exceeds what is asked for.
constexpr Bounds tolerance{1.0e-13, 1.0, false, true};

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
       {"space", space_table(), "geometry and grid", required},
       {"time", time_table(), "time span", required},
       {"integrator", &Scene::integrator, integrator_table(), "the grid momentum equations", required},
       {"constitutive", &Scene::constitutive, constitutive_table(), "the local equations of each particle"},
       {"output", &Scene::output, output_table(), "what is written, and when"},
       {"body", &Scene::bodies, body_table(), "the bodies, in order", required},
       {"boundary", &Scene::boundaries, boundary_table(geometry), "grid nodes that are held or driven"},
       contact_row(),
       {"probe", &Scene::probes, probe_table(), "material points whose history goes to `probes.csv`"},
       {"gravity", gravity_table(), "body force; absent: none"},
       Field<Scene>::named("material", &Scene::materials, material_table(), "the materials", required)});
}

}  // namespace

const Table& scene_table(Geometry geometry) {
  static const Table axisymmetric = make_scene_table(Geometry::axisymmetric),
                     plane_strain = make_scene_table(Geometry::plane_strain);
  return geometry == Geometry::axisymmetric ? axisymmetric : plane_strain;
}

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
        "`linear`: the hat functions of the original method"},
       {"gradients", &Scene::gradients, gradients,
        "velocity gradients between nodes, as in the original method, or between the centroids of what nodes "
        "collect: bodies that turn are not strained"}});
  return table;
}

const Table& time_table() {
  static const Table table = table_of<Scene>(
      "[time]", "The time span.",
      {{"start", &Scene::start, "s", intervals::finite, "may be negative, so that t = 0 is first touch"},
       {"end", &Scene::end, "s", intervals::finite, "later than `start`", required}});
  return table;
}

const Table& integrator_table() {
  using I = IntegratorDefinition;
  using intervals::positive;
  static const Table table = [] {
    Table t = table_of<I>(
        "[integrator]",
        "The grid momentum equations. Keys of a method that is not chosen are validated and ignored.",
        {{"method", &I::method, grid_methods,
          "steps of one of the explicit schemes, or an adaptive method of ARKODE", required},
         {"scheme", &I::scheme, step_schemes,
          "explicit: when particle stress is updated: first, last, or last after a second projection of "
          "velocity"},
         {"step", &I::step, "s", positive, "explicit: fixed step, instead of `courant`"},
         Field<I>(
             "courant", &I::courant, "1", positive,
             "explicit: adaptive step, this fraction of the critical one; used when neither it nor `step` "
             "is given")
             .otherwise(0.4),
         {"max_growth",
          &I::max_growth,
          "1",
          {1.0, intervals::infinite, true, false},
          "watchdog: the run fails when (kinetic + elastic) / (initial + external work) passes this; inf: "
          "only non-finite values stop it"},
         Field<I>("order", &I::order, Bounds{2.0, 5.0},
                  "arkode-*: order of the Butcher table, instead of `table`")
             .otherwise(3),
         {"table", &I::table, "arkode-*: a Butcher table by its SUNDIALS name, instead of `order`"},
         {"rtol", &I::rtol, "1", tolerance, "arkode-*: tolerance relative to the scene's own scales"},
         {"velocity_scale", &I::velocity_scale, "m/s", positive,
          "arkode-*: scale of velocities; absent: the largest of initial speeds, prescribed velocities and "
          "wave speed x strain scale"},
         {"strain_scale", &I::strain_scale, "1", positive,
          "arkode-*: scale of strains; absent: the least elastic limit of the scene's materials"},
         {"fixed_step", &I::fixed_step, "s", positive,
          "arkode-*: switches adaptivity off (convergence studies)"},
         {"max_step", &I::max_step, "s", positive, "arkode-*: longest step"},
         {"min_step", &I::min_step, "s", positive, "arkode-*: shortest step"},
         {"initial_step", &I::initial_step, "s", positive, "arkode-*: first step"},
         {"linear_solver", &I::linear_solver, linear_solvers, "arkode-implicit"},
         {"preconditioner", &I::preconditioner, preconditioners,
          "arkode-implicit with gmres: a factored matrix of earlier steps, or a diagonal"},
         {"remap", &I::remap, "s", positive,
          "arkode-implicit: longest Lagrangian phase between remaps; absent: phases end by `remap_travel` "
          "and "
          "`remap_strain` alone"},
         {"remap_travel", &I::remap_travel, "cells", positive,
          "arkode-implicit: a phase ends when a node that matters has moved so far"},
         {"remap_strain", &I::remap_strain, "1", positive,
          "arkode-implicit: a phase ends when a particle has strained or turned so much"}});
    t.alternatives = {{{"step", "courant"}, ""}, {{"order", "table"}, ""}};
    return t;
  }();
  return table;
}

const Table& constitutive_table() {
  using C = ConstitutiveDefinition;
  static const Table table = table_of<C>(
      "[constitutive]", "The local equations. Keys of a method that is not chosen are validated and ignored.",
      {{"method", &C::method, local_methods, "return mappings, error-controlled substeps, or CVODE"},
       {"rtol", &C::rtol, "1", tolerance, "substep, cvode: relative tolerance"},
       {"atol",
        &C::atol,
        "1",
        {0.0, 1.0, true, true},
        "substep, cvode: absolute tolerance, times each state's own scale"},
       {"solver", &C::solver, cvode_families, "cvode: multistep family"}});
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
      {{"acceleration", &Scene::gravity, "m/s^2", intervals::finite, "(r, z) or (x, y)", required}});
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
