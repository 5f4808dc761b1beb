#pragma once
#include <string>
#include <vector>

#include "materials/material_parameters.hpp"

namespace vitrum::app {

/// What a material asks for that can never happen.
std::vector<std::string> material_warnings(const MaterialParameters& material);

}  // namespace vitrum::app
