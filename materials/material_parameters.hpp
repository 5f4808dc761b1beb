#pragma once
#include <any>
#include <optional>
#include <string>

#include "materials/composite/damage.hpp"
#include "materials/composite/decohesion.hpp"
#include "materials/composite/drucker_prager.hpp"
#include "materials/composite/von_mises.hpp"
#include "materials/elasticity.hpp"

namespace vitrum {

/// The table of a registered law as read.
struct LawParameters {
  std::string table;
  std::any values;  ///< the law's `Parameters`
};

/// A [material.NAME] table as read. An absent table is a model that is neither stored nor run.
/// drucker_prager and von_mises exclude each other, `law` excludes all models but elasticity.
struct MaterialParameters {
  std::string name;
  ElasticParameters elastic;
  std::optional<DamageParameters> damage;
  std::optional<DruckerPragerParameters> drucker_prager;
  std::optional<VonMisesParameters> von_mises;
  std::optional<DecohesionParameters> decohesion;
  std::optional<LawParameters> law = {};
};

}  // namespace vitrum
