#pragma once
#include <utility>

#include "materials/batch.hpp"
#include "materials/registry.hpp"

namespace vitrum {

template <class Parameters>
Parameters parameters_of(const LawParameters& law) {
  Parameters parameters;
  std::size_t k = 0;
  for (const ParameterInfo<Parameters>& info : Parameters::describe()) {
    const std::vector<double>& value = law.values[k++];
    if (info.list != nullptr)
      parameters.*info.list = value;
    else
      parameters.*info.member = value.front();
  }
  return parameters;
}

/// The row of a law in the registry. Besides what Batch asks of it, the law has
///
///     struct Parameters { ...; static std::span<const ParameterInfo<Parameters>> describe(); };
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
  RegisteredLaw entry{std::move(table), std::move(text), {}, Law::all_variables(), {}, {}};
  for (const ParameterInfo<Parameters>& info : Parameters::describe())
    entry.parameters.push_back(
        {info.name, info.unit, info.fallback, info.bounds, info.description, info.list != nullptr});
  entry.contradiction =
      []([[maybe_unused]] const MaterialParameters& material) -> std::optional<Contradiction> {
    if constexpr (requires(const Parameters& p) { Law::contradiction(material.elastic, p); })
      return Law::contradiction(material.elastic, parameters_of<Parameters>(*material.law));
    return std::nullopt;
  };
  entry.make = [](const MaterialParameters& material, double cell) -> std::shared_ptr<const Material> {
    return std::make_shared<Batch<Law>>(
        material, Law(material.elastic, parameters_of<Parameters>(*material.law), cell));
  };
  return entry;
}

}  // namespace vitrum
