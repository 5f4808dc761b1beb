#pragma once
#include <optional>
#include <string>

#include "app/warnings.hpp"
#include "integrators/grid/grid_integrator.hpp"

namespace vitrum::app {

/// Scenes in which nothing moves; bodies that meet faster than waves travel in them.
void warn_of_motion(const Scene& scene, const System& system, Warnings& list);

/// Linear functions where bodies cross more than a few cells of the grid, by their speed at the start or that
/// of a boundary: every crossing makes or loses energy.
void warn_of_travel(const Scene& scene, const System& system, Warnings& list);
/// Domains that follow the stretch of a body with one particle a cell: such rows tear between cells.
void warn_of_one_row(const Scene& scene, Warnings& list);

/// Strengths that scatter over orders of magnitude, or whose law's value is that of a volume unlike
/// particles'.
void warn_of_scatter(const Scene& scene, const System& system, Warnings& list);

/// What the end of a run with contact tells: surfaces that were pressed further than they bear.
void warn_of_depth(const System& system, Warnings& list);

/// What the end of an adaptive run tells: hardly a step was as long as its tolerance allowed.
std::optional<std::string> idle_tolerance(const Scene& scene, const IntegratorCounters& counters);

}  // namespace vitrum::app
