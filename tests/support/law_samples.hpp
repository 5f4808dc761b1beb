#pragma once
#include <any>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "materials/johnson_cook.hpp"
#include "materials/johnson_holmquist.hpp"
#include "materials/maxwell.hpp"
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
  bool turns = true;     ///< whether all directions of the grid are one: not of a plane, whose L_e they give

  /// Free of stress; where the law scatters, weaker than it.
  PointState start() const {
    PointState state = material->start({});
    if (material->scatter()) value_of(*material, state, *material->column(StrengthScatter::column)) = 0.8;
    return state;
  }
};

/// Parameters of a registered law.
struct RegisteredSample {
  ElasticParameters elastic;
  std::any values;  ///< the law's `Parameters`
  double strain = 1e-3, rate = 1e4;
};

/// By the law's table. A new law has its entry here; the conformance test asks for it.
inline const std::map<std::string, RegisteredSample>& registered_samples() {
  static const std::map<std::string, RegisteredSample> samples{
      {"johnson_holmquist",  // float glass
       {{2530.0, 74.558e9, 0.22629},
        JohnsonHolmquistParameters{.A = 0.93,
                                   .N = 0.77,
                                   .B = 0.088,
                                   .M = 0.35,
                                   .fractured_limit = 0.5,
                                   .C = 0.003,
                                   .T = 0.15e9,
                                   .HEL = 5.95e9,
                                   .PHEL = 2.92e9,
                                   .D1 = 0.053,
                                   .D2 = 0.85,
                                   .K2 = -138.0e9,
                                   .K3 = 290.0e9},
        2e-2}},
      {"johnson_cook",  // 4340 steel
       {{7830.0, 205.0e9, 0.29},
        JohnsonCookParameters{.A = 792.0e6,
                              .B = 510.0e6,
                              .n = 0.26,
                              .C = 0.014,
                              .m = 1.03,
                              .melting_temperature = 1793.0,
                              .heat_capacity = 477.0},
        2e-2}},
      {"maxwell",
       {{1070.0, 1.31e9, 0.39},
        MaxwellParameters{.ratios = {0.5, 0.3, 0.15}, .times = {2e-8, 1e-6, 3.0}},
        1e-2}},
  };
  return samples;
}

inline LawSample sample_of(const RegisteredLaw& law, const RegisteredSample& sample) {
  MaterialParameters p;
  p.name = law.table;
  p.elastic = sample.elastic;
  p.law = LawParameters{law.table, sample.values};
  return {law.table, law.make(p, cell), sample.strain, sample.rate};
}

/// The minimal law, every registered law, and every composition of the composite, damage with every
/// reading of the paper.
inline std::vector<LawSample> law_samples() {
  std::vector<LawSample> all{{"minimal", minimal_material(), 4e-3}};
  for (const RegisteredLaw& law : registered_laws())
    all.push_back(sample_of(law, registered_samples().at(law.table)));
  for (const NamedMaterial& named : all_compositions())
    all.push_back({.name = named.name,
                   .material = make_material(named.parameters, cell),
                   .turns = !named.parameters.decohesion});
  for (const NamedMaterial& named : rated_damages())
    all.push_back({.name = named.name, .material = make_material(named.parameters, cell)});
  for (const NamedMaterial& named : readings())
    all.push_back({.name = named.name, .material = make_material(named.parameters, cell), .turns = false});
  MaterialParameters scattered = damaging_glass();
  scattered.damage->scatter = StrengthScatter{7.0, 1e-9};
  all.push_back({.name = "scattered damage", .material = make_material(scattered, cell)});
  RegisteredSample ceramic = registered_samples().at("johnson_holmquist");
  std::any_cast<JohnsonHolmquistParameters&>(ceramic.values).scatter = StrengthScatter{7.0, 1e-9};
  all.push_back(sample_of(*find_law("johnson_holmquist"), ceramic));
  all.back().name = "scattered johnson_holmquist";
  return all;
}

}  // namespace vitrum::test
