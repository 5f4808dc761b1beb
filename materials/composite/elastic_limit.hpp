#pragma once
#include "materials/material_parameters.hpp"

namespace vitrum {

/// Strain at which a material leaves elasticity, the least over its models: yield / E for plasticity, the
/// uniaxial strain that eq. 7 asks for a tenth of all cracks at 1000 /s (or at the fixed rate) for damage.
/// 1e-3 for a material that stays elastic. A scale for tolerances, not a law.
double elastic_limit(const MaterialParameters& parameters);

}  // namespace vitrum
