#pragma once
#include <utility>

#include "materials/batch.hpp"
#include "materials/registry.hpp"
#include "schema/field.hpp"

namespace vitrum {

/// The row of a law in the registry. Besides what Batch asks of it, the law has
///
///     struct Parameters { ...; static schema::Fields<Parameters> rows(); };
///     Law(const ElasticParameters& elastic, const Parameters& parameters, double cell);
///     static std::vector<Variable> all_variables();
///
/// and may have
///
///     static std::optional<Contradiction> contradiction(const ElasticParameters& elastic,
///                                                       const Parameters& parameters);
template <class Law>
RegisteredLaw law(std::string table, std::string text) {
  using Parameters = typename Law::Parameters;
  static constexpr auto parameters_of = [](const MaterialParameters& material) -> const Parameters& {
    return std::any_cast<const Parameters&>(material.law->values);
  };
  RegisteredLaw entry{};
  entry.table = std::move(table);
  entry.text = std::move(text);
  entry.variables = Law::all_variables();
  entry.keys = schema::table_of("[material.NAME." + entry.table + ']', entry.text + '.', Parameters::rows());
  entry.defaults = [](std::string_view name) { return LawParameters{std::string(name), Parameters{}}; };
  entry.values = [](const LawParameters& law) -> const void* {
    return std::any_cast<Parameters>(&law.values);
  };
  entry.contradiction =
      []([[maybe_unused]] const MaterialParameters& material) -> std::optional<Contradiction> {
    if constexpr (requires(const Parameters& p) { Law::contradiction(material.elastic, p); })
      return Law::contradiction(material.elastic, parameters_of(material));
    return std::nullopt;
  };
  entry.make = [](const MaterialParameters& material, double cell) -> std::shared_ptr<const Material> {
    return std::make_shared<Batch<Law>>(material, Law(material.elastic, parameters_of(material), cell));
  };
  return entry;
}

}  // namespace vitrum
