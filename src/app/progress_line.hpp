#pragma once
#include <cstddef>
#include <string>

#include "integrators/grid/grid_integrator.hpp"
#include "observe/energy_totals.hpp"

namespace vitrum::app {

/// How far a run has come.
struct Standing {
  double part = 0.0;  ///< of the time from start to end
  double left = 0.0;  ///< s, estimated
  double time = 0.0;  ///< s, of the scene
  double step = 0.0;  ///< s, the last one
  IntegratorCounters counters;
  EnergyTotals energy;  ///< as files show it, in energy_unit
  const char* energy_unit = "J";
};

/// A line of at most so many columns: a bar, and what fits in the order of its importance.
std::string progress_line(const Standing& standing, std::size_t columns);

}  // namespace vitrum::app
