#pragma once
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "app/warnings.hpp"

namespace vitrum::app {

/// Two bodies as they stand at the start.
struct Encounter {
  std::size_t first, second;  ///< bodies
  double gap;                 ///< m, between their shapes
  double particle_gap;        ///< m, between the nearest of their particles; NaN: more than 4 cells
  std::size_t
      common_nodes;  ///< of the grid: where there are any, one velocity field joins the bodies already
};

/// The bodies and boundaries of a scene to each other at the start.
struct StartGeometry {
  std::vector<Encounter> encounters;        ///< within 4 cells, and of each body with the nearest other one
  std::vector<std::size_t> boundary_nodes;  ///< nodes with mass in each boundary's box
};

StartGeometry start_geometry(const Scene& scene, const System& system);

/// For `vitrum check`.
nlohmann::ordered_json to_json(const StartGeometry& geometry, const Scene& scene);
std::string to_text(const StartGeometry& geometry, const Scene& scene);

/// Bodies joined across a gap, disks that are tori, bodies that fly and meet nothing,
/// boundaries that no body is at or heads for.
void warn_of_geometry(const Scene& scene, const System& system, Warnings& list);

}  // namespace vitrum::app
