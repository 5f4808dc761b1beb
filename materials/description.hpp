#pragma once
#include <optional>
#include <span>
#include <string_view>

#include "materials/point_state.hpp"

namespace vitrum {

/// Interval of admissible values; the ends belong to it unless marked open.
struct Bounds {
  double lowest, highest;
  bool lowest_open = false, highest_open = false;

  constexpr bool contain(double v) const {
    return (lowest_open ? v > lowest : v >= lowest) && (highest_open ? v < highest : v <= highest);
  }
};

/// A number a model reads from the scene. The scene reader, the scene reference and the resolved scene are
/// generated from this.
template <class Parameters>
struct ParameterInfo {
  std::string_view name;  ///< key in the scene
  double Parameters::*member;
  std::string_view unit;           ///< "1" for pure numbers
  std::optional<double> fallback;  ///< value when the key is absent; none: the key is required
  Bounds bounds;
  std::string_view description;  ///< one phrase, with the paper's equation number
};

/// An internal variable a model carries. Output attributes, the result reference and tolerances are generated
/// from this.
struct VariableInfo {
  Variable variable;
  std::string_view name;  ///< column of the CSV file, dataset of the result file
  std::string_view unit;
  double scale;  ///< magnitude at which it matters (error weights)
  Bounds bounds;
  std::string_view description;
};

/// Every internal variable, in the order of `Variable`.
std::span<const VariableInfo> all_variables();

}  // namespace vitrum
