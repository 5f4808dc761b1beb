#pragma once
#include <muParser.h>

#include "scene/formulas.hpp"

namespace vitrum::scene {

/// Time (s) and place (m) that a formula is evaluated at.
struct FormulaVariables {
  double t = 0.0;
  std::array<double, 2> place{};
};

/// Makes units, constants and parameters known to a parser, and, where they are given, t and the coordinates.
void prepare(mu::Parser& parser, const Formulas& formulas, double* t, std::array<double, 2>* place);

}  // namespace vitrum::scene
