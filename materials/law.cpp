#include "materials/law.hpp"

#include <stdexcept>

namespace vitrum {
namespace {

std::vector<Variable> with_dissipated(std::vector<Variable> variables, bool dissipates) {
  if (dissipates) variables.push_back(dissipated_variable());
  return variables;
}

}  // namespace

Variable dissipated_variable() {
  return {.name = "dissipated",
          .unit = "J/m^3",
          .text = "energy dissipated by all models, per volume of material",
          .scale = 1.0e4,
          .bounds = intervals::not_negative};
}

Material::Material(MaterialParameters parameters, std::vector<Variable> variables, bool dissipates,
                   std::vector<std::size_t> stress_columns, std::optional<std::size_t> damage_column)
    : parameters_(std::move(parameters)),
      variables_(with_dissipated(std::move(variables), dissipates)),
      columns_(components_of(variables_)),
      stress_columns_(std::move(stress_columns)),
      damage_column_(damage_column),
      dissipates_(dissipates) {
  if (columns_.size() > most_columns)
    throw std::logic_error("material '" + parameters_.name + "': more variables than a point can hold");
}

std::optional<std::size_t> Material::column(std::string_view name) const {
  for (std::size_t k = 0; k < columns_.size(); ++k)
    if (columns_[k].name == name) return k;
  return std::nullopt;
}

double& value_of(const Material& material, PointState& state, std::size_t k) {
  const bool is_own = !material.dissipates() || k + 1 < material.columns().size();
  return is_own ? state.variables[k] : state.dissipated;
}
double value_of(const Material& material, const PointState& state, std::size_t k) {
  const bool is_own = !material.dissipates() || k + 1 < material.columns().size();
  return is_own ? state.variables[k] : state.dissipated;
}

std::string_view event_name(EventKind kind) {
  switch (kind) {
    case EventKind::damage:
      return "damage";
    case EventKind::yield:
      return "yield";
    case EventKind::peak:
      return "peak";
    case EventKind::localisation:
      return "localisation";
    case EventKind::separation:
      return "separation";
    case EventKind::closure:
      return "closure";
  }
  return "unknown";
}

}  // namespace vitrum
