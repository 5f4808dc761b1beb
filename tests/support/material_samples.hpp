#pragma once
#include <string>
#include <vector>

#include "support/composite_material.hpp"

namespace vitrum::test {

inline constexpr double cell = 1.0e-3;  // m, the paper's grid

/// The paper's glass: elasticity alone; the models are switched on one by one.
inline MaterialParameters bare_glass() {
  MaterialParameters p;
  p.name = "glass";
  p.elastic = {2500.0, 72.0e9, 0.25};
  return p;
}
inline DamageParameters glass_damage() {
  return {0.83e6, 5.0e26, 6.0, 1.0, 0.0};
}
inline DecohesionParameters glass_decohesion() {
  return {5.0e-6, 1.0, 50.0, 0.0, false};
}
inline DruckerPragerParameters glass_drucker_prager() {
  return {43.0e6, 1.8, false};
}

inline MaterialParameters damaging_glass() {
  MaterialParameters p = bare_glass();
  p.damage = glass_damage();
  return p;
}
inline MaterialParameters fracturing_glass(bool all_planes = false) {
  MaterialParameters p = damaging_glass();
  p.decohesion = glass_decohesion();
  p.decohesion->search_all_planes = all_planes;
  return p;
}

/// The paper's steel: elasticity alone; the models are switched on one by one.
inline MaterialParameters bare_steel() {
  MaterialParameters p;
  p.name = "steel";
  p.elastic = {7800.0, 195.0e9, 0.25};
  return p;
}
inline VonMisesParameters steel_von_mises() {
  return {359.0e6, 484.0e6, 9.6e9, 9.6e9};
}
inline DecohesionParameters steel_decohesion() {
  return {1.6e-9, 1.0, 1.0, 0.0, false};
}
inline MaterialParameters flowing_steel() {
  MaterialParameters p = bare_steel();
  p.von_mises = steel_von_mises();
  return p;
}
inline MaterialParameters fracturing_steel(bool all_planes = false) {
  MaterialParameters p = flowing_steel();
  p.decohesion = steel_decohesion();
  p.decohesion->search_all_planes = all_planes;
  return p;
}

struct NamedMaterial {
  std::string name;
  MaterialParameters parameters;
};

/// Damage by every reading of eq. 7's strain and rate but the default.
inline std::vector<NamedMaterial> rated_damages() {
  const auto glass = [](const std::string& name, auto choose) {
    NamedMaterial named{name, damaging_glass()};
    choose(*named.parameters.damage);
    return named;
  };
  using P = DamageParameters;
  return {glass("volumetric", [](P& p) { p.volumetric = true; }),
          glass("current rate", [](P& p) { p.history = DamageRate::current; }),
          glass("rate of any sign", [](P& p) { p.history = DamageRate::maximum_any_sign; }),
          glass("averaged rate", [](P& p) { p.averaging_time = 3.0e-8; }),
          glass("fixed rate", [](P& p) { p.fixed_rate = 1.0e3; })};
}

/// Faces that rub before a material that flows at stresses of their own size.
inline std::vector<NamedMaterial> rubbing_and_flowing() {
  const auto rubbing = [](const std::string& name, double friction, auto choose) {
    NamedMaterial named{name, fracturing_glass()};
    named.parameters.decohesion = DecohesionParameters{5.0e-8, 1.0, 1.0, 0.0, false};
    named.parameters.decohesion->friction = friction;
    choose(named.parameters);
    return named;
  };
  using P = MaterialParameters;
  return {rubbing("faces rub, hardening flow", 0.4,
                  [](P& p) {
                    p.von_mises = VonMisesParameters{60.0e6, 80.0e9, 9.6e9, 0.0};
                  }),
          rubbing("faces rub, softening flow", 0.4,
                  [](P& p) {
                    p.damage.reset();
                    p.von_mises = VonMisesParameters{60.0e6, 80.0e6, 9.6e9, 9.6e9};
                  }),
          rubbing("faces rub, weak flow under pressure", 0.8,
                  [](P& p) {
                    p.drucker_prager = DruckerPragerParameters{20.0e6, 0.5, false};
                  }),
          rubbing("faces rub, associated flow", 0.4, [](P& p) {
            p.drucker_prager = DruckerPragerParameters{20.0e6, 0.3, true};
          })};
}

/// Glass with all its models, by every reading of eqs. 7 and 10 to 18 but the default, one at a time, and by
/// all of them at once.
inline std::vector<NamedMaterial> readings() {
  const auto glass = [](const std::string& name, auto choose) {
    NamedMaterial named{name, fracturing_glass()};
    named.parameters.drucker_prager = glass_drucker_prager();
    choose(named.parameters);
    return named;
  };
  using P = MaterialParameters;
  std::vector<NamedMaterial> all{
      glass("pressure waves", [](P& p) { p.damage->pressure_wave = true; }),
      glass("undamaged moduli", [](P& p) { p.decohesion->undamaged = true; }),
      glass("pressure counts", [](P& p) { p.decohesion->pressure_counts = true; }),
      glass("tension alone", [](P& p) { p.decohesion->partial_compression = false; }),
      glass("no flow behind the plane", [](P& p) { p.decohesion->flow_behind_plane = false; }),
      glass("given tau_bar_0", [](P& p) { p.decohesion->tau_bar_0 = 60.0e6; }),
      glass("rubble bears pressure", [](P& p) { p.decohesion->separated = Separated::pressure; }),
      glass("rubble bears shear",
            [](P& p) {
              p.decohesion->separated = Separated::drucker_prager;
              p.drucker_prager->beta = 0.6;
            }),
      glass("faces rub", [](P& p) { p.decohesion->friction = 0.3; }),
      glass("rubble bears nothing", [](P& p) { p.decohesion->separated = Separated::nothing; }),
      glass("rubble is removed", [](P& p) { p.decohesion->separated = Separated::removed; }),
      glass("all at once", [](P& p) {
        p.damage->pressure_wave = true;
        p.decohesion->undamaged = p.decohesion->pressure_counts = true;
        p.decohesion->partial_compression = p.decohesion->flow_behind_plane = false;
        p.decohesion->tau_bar_0 = 60.0e6;
        p.decohesion->separated = Separated::pressure;
      })};
  for (NamedMaterial& named : rubbing_and_flowing()) all.push_back(std::move(named));
  return all;
}

/// The twelve compositions: damage or not, no yield, von Mises or Drucker-Prager, decohesion or not.
/// Strengths are chosen such that every model acts at strains of about 1e-3.
inline std::vector<NamedMaterial> all_compositions() {
  std::vector<NamedMaterial> all;
  for (const bool damage : {false, true})
    for (const int yielding : {0, 1, 2})
      for (const bool decohesion : {false, true}) {
        MaterialParameters p = bare_glass();
        std::string name = "elastic";
        if (damage) p.damage = glass_damage(), name += "+damage";
        if (yielding == 1) {
          p.von_mises = VonMisesParameters{40.0e6, 50.0e6, 10.0e9, 40.0e9};
          name += "+von_mises";
        }
        if (yielding == 2) p.drucker_prager = glass_drucker_prager(), name += "+drucker_prager";
        if (decohesion) p.decohesion = glass_decohesion(), name += "+decohesion";
        all.push_back({name, p});
      }
  return all;
}

}  // namespace vitrum::test
