#pragma once
#include <optional>

#include "integrators/grid/error_scales.hpp"
#include "integrators/sundials/butcher_table.hpp"

namespace vitrum {

/// What a scene says about an adaptive method.
struct AdaptiveSettings {
  sundials::ButcherTable table;
  double tolerance = 1.0e-3;  ///< relative to the scales
  ErrorScales scales;
  std::optional<double> fixed_step, longest_step, shortest_step, first_step;  ///< s
};

}  // namespace vitrum
