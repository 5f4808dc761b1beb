#pragma once
#include <optional>
#include <string>

#include "materials/damage.hpp"
#include "materials/decohesion.hpp"
#include "materials/drucker_prager.hpp"
#include "materials/elasticity.hpp"
#include "materials/von_mises.hpp"

namespace vitrum {

/// A [material.NAME] table as read. An absent table is a model that is neither stored nor run.
/// drucker_prager and von_mises exclude each other.
struct MaterialParameters {
  std::string name;
  ElasticParameters elastic;
  std::optional<DamageParameters> damage;
  std::optional<DruckerPragerParameters> drucker_prager;
  std::optional<VonMisesParameters> von_mises;
  std::optional<DecohesionParameters> decohesion;
};

}  // namespace vitrum
