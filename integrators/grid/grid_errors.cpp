// What counts of nodes: how far they have gone, and the errors of their unknowns.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "integrators/grid/grid_system.hpp"
#include "integrators/grid/phase_length.hpp"

namespace vitrum {

double GridSystem::travel(const double* y) const {
  // A node of little mass may go far without any particle following it.
  double way = 0.0;
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    if (nodes_.mass[k] > 1e-3 * mean_mass_) way = std::max(way, std::abs(y[k]));
  return way / system_.cell;
}

double GridSystem::travel_at_walls(const double* y) const {
  constexpr double reach = 3.0;  // cells: what stands at a wall has its nodes there
  double way = 0.0;
  const std::vector<mpm::Boundary>& walls = system_.grid.boundaries();
  for (std::size_t wall = 0; wall < walls.size(); ++wall) {
    std::array<double, 2> gone{};
    for (std::size_t c = 0; c < 2 && walls[wall].moves; ++c)
      gone[c] = walls[wall].way(c, start_time_, committed_time_);
    for (std::size_t k = 0; k < nodes_.size(); ++k) {
      const auto [column, row] = mpm::place_of(system_.grid, nodes_.node[k]);
      if (nodes_.mass[k] > 1e-3 * mean_mass_ &&
          cells_to_held(system_.grid, wall, {static_cast<double>(column), static_cast<double>(row)}) <= reach)
        way = std::max(way, std::abs(y[k] - gone[nodes_.component[k]]));
    }
  }
  return way / system_.cell;
}

/// Error weights contain the root of the mass: what counts is the error of momentum and of the work that
/// forces could do, not that of a node with next to no mass.
double GridSystem::weight_of_mass(std::size_t unknown) const {
  return std::sqrt(nodes_.mass[unknown % nodes_.size()] / mean_mass_);
}

double GridSystem::tolerance_of(std::size_t unknown) const {
  const std::size_t n = nodes_.size();
  const double scale = unknown < n ? scales_.strain * scales_.length
                       : unknown < 2 * n
                           ? scales_.velocity
                           : 1e6 * mean_mass_ * static_cast<double>(n) * scales_.velocity * scales_.velocity;
  return tolerance_ * scale / (unknown < 2 * n ? weight_of_mass(unknown) : 1.0);
}

void GridSystem::error_weights(double* weights) const {
  for (std::size_t k = 0; k < size(); ++k) weights[k] = 1.0 / tolerance_of(k);
}

void GridSystem::add_errors(const double* errors, ErrorEstimate& estimate) const {
  const std::size_t n = nodes_.size();
  if (n == 0) return;
  double displacement = 0.0, velocity = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const double u = errors[k] * tolerance_ / tolerance_of(k),
                 v = errors[n + k] * tolerance_ / tolerance_of(n + k);
    displacement += u * u, velocity += v * v;
  }
  const auto count = static_cast<double>(n);
  estimate.position += std::sqrt(displacement / count);
  estimate.velocity += std::sqrt(velocity / count);
  estimate.total += std::sqrt((displacement + velocity) / (2.0 * count));
}

std::string GridSystem::describe(std::size_t unknown) const {
  const std::size_t n = nodes_.size();
  if (unknown >= 2 * n) return works_ && unknown == 2 * n ? "external work" : "impulse of contact";
  return fmt::format("{} {}", unknown < n ? "displacement" : "velocity",
                     mpm::describe_unknown(system_, nodes_, unknown % n));
}

}  // namespace vitrum
