#include <fmt/format.h>

#include <array>
#include <cmath>
#include <initializer_list>
#include <map>
#include <memory>
#include <span>

#include "materials/registry.hpp"
#include "scene/checks.hpp"
#include "scene/toml_text.hpp"

namespace vitrum::scene {
namespace {

/// Values of columns by name; 0 where the file has none.
class Values {
 public:
  explicit Values(const StateDefinition& given) : given_(&given) {}
  double at(std::string_view name) const {
    const auto found = given_->variables.find(name);
    return found != given_->variables.end() ? found->second : 0.0;
  }

 private:
  const StateDefinition* given_;
};
using Names = std::initializer_list<std::string_view>;

/// Reports the first of `names` that is not zero.
bool require_zero(const TableView& table, const Values& values, Names names, std::string_view because) {
  for (const std::string_view name : names)
    if (values.at(name) != 0.0) {
      table.fail(name, fmt::format("0: {}", because));
      return false;
    }
  return true;
}

/// What a model that the material does not name would keep.
bool check_models(const TableView& table, const MaterialParameters& m, const Values& values) {
  return (m.damage ||
          require_zero(table, values, {"crack_density", "max_rate"}, "the material has no damage")) &&
         (m.von_mises || m.drucker_prager ||
          require_zero(table, values, {"plastic_strain"}, "the material has no yield surface")) &&
         (m.decohesion || require_zero(table, values,
                                       {"decohesion", "opening_n", "opening_t", "normal_r", "normal_z",
                                        "effective_length", "cohesive_strength"},
                                       "the material has no decohesion"));
}

/// What a plane keeps that is not there: a point is localised where it has an effective length.
bool check_intact(const TableView& table, const Values& values) {
  return require_zero(table, values,
                      {"decohesion", "opening_n", "opening_t", "normal_r", "normal_z", "cohesive_strength"},
                      "the point is not localised (it would have an effective_length > 0)");
}

void check_plane(const TableView& table, const DecohesionParameters& parameters, const Values& values) {
  constexpr double rounding = 1e-6;  // of a plane that has turned with its particle
  const double r = values.at("normal_r"), z = values.at("normal_z"), decohesion = values.at("decohesion");
  const double length = std::hypot(r, z);
  const bool hoop = r == 0.0 && z == 0.0;
  if (!hoop && !(std::abs(length - 1.0) <= rounding)) {
    table.report(table.has("normal_r") ? "normal_r" : "normal_z",
                 fmt::format("found a normal ({}, {}) of length {:.6g}, expected a unit vector",
                             number_text(r), number_text(z), length));
  } else if (hoop && !parameters.search_all_planes) {
    table.report(
        "effective_length",
        "found a localised point without a normal (normal_r, normal_z), which is that of a hoop plane; "
        "expected a unit vector, or decohesion.plane = \"all\"");
  } else if (decohesion < 1.0 && !(values.at("cohesive_strength") > 0.0)) {
    table.report(
        "cohesive_strength",
        fmt::format("found {} on a plane that has not separated, expected the traction at its onset (> 0)",
                    number_text(values.at("cohesive_strength"))));
  } else if (values.at("opening_n") < -rounding * parameters.opening) {
    table.fail("opening_n", "at least 0: faces do not penetrate");
  } else if (hoop && values.at("opening_t") != 0.0) {
    table.fail("opening_t", "0: a hoop plane does not slide");
  } else if (decohesion == 0.0) {
    require_zero(table, values, {"opening_n", "opening_t"},
                 "decohesion is 0, and openings are what it brings");
  }
}

/// What the composite's models ask of their variables.
void check_composite(const TableView& table, const MaterialParameters& material, const Values& values) {
  if (!check_models(table, material, values)) return;
  if (values.at("effective_length") > 0.0)
    check_plane(table, *material.decohesion, values);
  else
    check_intact(table, values);
}

/// What the law does not store.
void check_law(const TableView& table, const Material& material, const Values& values) {
  for (const Component& column : all_columns())
    if (!material.column(column.name) && column.name != dissipated_variable().name)
      require_zero(table, values, {column.name}, "the material has no such variable");
}

}  // namespace

void check_state(const TableView& document, const PointScene& point) {
  const auto table = document.table("state");
  if (!table || !point.given) return;
  const Values values(*point.given);
  if (!point.material.law)
    check_composite(*table, point.material, values);
  else if (document.diagnostics().empty())
    check_law(*table, *make_material(point.material, 1.0), values);
}

PointState start_of(const PointScene& point) {
  const std::shared_ptr<const Material> material = make_material(point.material, 1.0);
  PointState state = material->start({});
  if (!point.given) return state;
  state.elastic_strain = point.given->elastic_strain;
  for (const auto& [name, value] : point.given->variables) {
    if (const auto column = material->column(name)) value_of(*material, state, *column) = value;
    if (name == dissipated_variable().name) state.dissipated = value;
  }
  return state;
}

}  // namespace vitrum::scene
