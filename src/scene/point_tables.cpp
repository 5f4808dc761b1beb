#include "materials/registry.hpp"
#include "scene/scene_tables.hpp"
#include "schema/field.hpp"

namespace vitrum::scene {
namespace {

using schema::Field;
using schema::Fields;
using schema::required;
using schema::Table;
using schema::table_of;

Field<StateDefinition> variable_row(const Component& column) {
  using S = StateDefinition;
  const auto get = [name = column.name](const S& state) -> std::optional<schema::Value> {
    const auto found = state.variables.find(name);
    return found != state.variables.end() ? std::optional<schema::Value>(found->second) : std::nullopt;
  };
  const auto set = [name = column.name](S& state, const schema::Value& value) {
    state.variables[name] = std::get<double>(value);
  };
  auto row = Field<S>::of(column.name, {schema::Kind::number}, column.text, schema::Need::optional, get, set);
  row.unit = column.unit;
  const bool of_unit_vector = column.bounds.lowest == -1.0;  // whose length rounding may leave above 1
  row.bounds = of_unit_vector ? intervals::finite : column.bounds;
  return row;
}

const Table& state_table() {
  static const Table table = [] {
    Fields<StateDefinition> rows{{"elastic_strain", &StateDefinition::elastic_strain, "1", intervals::finite,
                                  "elastic strain (rr, zz, tt, rz) or (xx, yy, zz, xy)"}};
    for (const Component& column : all_columns()) rows.push_back(variable_row(column));
    return table_of("[state]",
                    "State at the start of the path, e.g. of a particle whose increment failed (a run writes "
                    "`failed_point.toml`).",
                    rows);
  }();
  return table;
}

const Table& path_table() {
  using P = PointScene;
  static const Table table = table_of<P>(
      "[path]", "",
      {Field<P>("time", &P::time, "s", intervals::finite, "times of `strain`", required)
           .expecting("a list of two or more increasing finite numbers (s)"),
       Field<P>("strain", &P::strain, "1", intervals::finite,
                "total strain (rr, zz, tt, rz) or (xx, yy, zz, xy), tensor shear; linear between times",
                required)
           .expecting("a list of 4 finite numbers for each time"),
       {"size", &P::size, "m", intervals::positive,
        "side of the cell around the point, for the effective length", required},
       {"samples", &P::samples, Bounds{1.0, 1.0e6}, "rows written for each segment of the path"}});
  return table;
}

}  // namespace

const Table& point_table() {
  using P = PointScene;
  static const Table table = table_of<P>(
      "Point file", "`vitrum point` drives one material point along a strain path.",
      {{"parameters", &P::parameters, "1", intervals::finite,
        "numbers by name, for formulas: wherever a number stands, a text that begins with `=` is one"},
       {"evaluated", &P::evaluated,
        "of a failed point's file: parameters (`NAME = VALUE`) whose formulas have become numbers, so that "
        "nothing changes with them any more"},
       Field<P>::named("material", &P::material, material_table(), "the material, as in a scene", required)
           .expecting("one table [material.NAME]"),
       {"constitutive", &P::constitutive, constitutive_table(), "as in a scene"},
       {"state", &P::given, state_table(), "state at the start of the path (default: virgin)"},
       {"path", path_table(), "the strain path", required}});
  return table;
}

}  // namespace vitrum::scene
