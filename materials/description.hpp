#pragma once
#include <optional>
#include <string_view>
#include <vector>

#include "schema/bounds.hpp"

namespace vitrum {

/// A number, or a list of numbers, that a law reads from its table of the scene. The scene reader, the scene
/// reference and the resolved scene are generated from this.
template <class Parameters>
struct ParameterInfo {
  std::string_view name;           ///< key in the scene
  double Parameters::*member;      ///< null for a list
  std::string_view unit;           ///< "1" for pure numbers
  std::optional<double> fallback;  ///< value when the key is absent; none: the key is required
  Bounds bounds;                   ///< of the number, or of each of the list
  std::string_view description;    ///< one phrase, with the paper's equation number
  std::vector<double> Parameters::*list = nullptr;  ///< a list of one or more; always required
};

}  // namespace vitrum
