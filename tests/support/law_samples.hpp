#pragma once
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "materials/registry.hpp"
#include "support/material_samples.hpp"
#include "support/minimal_law.hpp"

namespace vitrum::test {

/// A material for tests that hold of every law.
struct LawSample {
  std::string name;
  std::shared_ptr<const Material> material;
  double strain = 1e-3;  ///< size of strains at which the law does what it is for
  double rate = 1e4;     ///< 1/s
};

/// Parameters of a registered law; keys that are absent have their default.
struct RegisteredSample {
  ElasticParameters elastic;
  std::map<std::string, std::vector<double>> values;
  double strain = 1e-3, rate = 1e4;
};

/// By the law's table. A new law has its entry here; the conformance test asks for it.
inline const std::map<std::string, RegisteredSample>& registered_samples() {
  static const std::map<std::string, RegisteredSample> samples{};
  return samples;
}

inline LawSample sample_of(const RegisteredLaw& law) {
  const RegisteredSample& sample = registered_samples().at(law.table);
  MaterialParameters p;
  p.name = law.table;
  p.elastic = sample.elastic;
  p.law = LawParameters{law.table, {}};
  for (const ParameterRow& row : law.parameters) {
    const auto given = sample.values.find(std::string(row.name));
    p.law->values.push_back(given != sample.values.end() ? given->second : std::vector{row.fallback.value()});
  }
  return {law.table, law.make(p, cell), sample.strain, sample.rate};
}

/// The minimal law, every registered law, and the composite without planes, whose effective length depends on
/// how they lie in the grid.
inline std::vector<LawSample> law_samples() {
  std::vector<LawSample> all{{"minimal", minimal_material(), 4e-3}};
  for (const RegisteredLaw& law : registered_laws()) all.push_back(sample_of(law));
  for (const NamedMaterial& named : all_compositions())
    if (!named.parameters.decohesion) all.push_back({named.name, make_material(named.parameters, cell)});
  return all;
}

}  // namespace vitrum::test
