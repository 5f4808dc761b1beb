#pragma once
#include "materials/law.hpp"

namespace vitrum {

/// Composes the models that `parameters` names. cell: m, for the effective length L_e.
std::shared_ptr<const Material> make_composite(const MaterialParameters& parameters, double cell);

/// What the models store, in order.
std::vector<Variable> damage_variables();
std::vector<Variable> averaged_rate_variables();
std::vector<Variable> plasticity_variables();
std::vector<Variable> decohesion_variables();

}  // namespace vitrum
