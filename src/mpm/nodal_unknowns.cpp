#include "mpm/nodal_unknowns.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numeric>

namespace vitrum::mpm {

void number_unknowns(const System& system, NodalUnknowns& u) {
  const Grid& grid = system.grid;
  const std::size_t nodes = grid.blocks().size() * block_nodes;
  const double* mass = grid.field(Field::mass);
  u.node.clear(), u.component.clear(), u.mass.clear();
  u.number.assign(2 * nodes, -1);
  for (std::size_t n = 0; n < nodes; ++n) {
    if (!(mass[n] > std::numeric_limits<double>::min())) continue;
    for (std::size_t c = 0; c < 2; ++c) {
      if (grid.constraint(c, n) != Constraint::free) continue;
      u.number[2 * n + c] = static_cast<std::int32_t>(u.node.size());
      u.node.push_back(static_cast<std::uint32_t>(n));
      u.component.push_back(static_cast<std::uint8_t>(c));
      u.mass.push_back(mass[n]);
    }
  }
}

void fill_field(System& system, const NodalUnknowns& unknowns, const double* values,
                std::span<const std::array<double, 2>> of_boundaries, Field component_0) {
  Grid& grid = system.grid;
  for (std::size_t c = 0; c < 2; ++c) {
    double* field = grid.field(static_cast<Field>(static_cast<std::size_t>(component_0) + c));
    system.team->for_each_chunk(grid.blocks().size(), [&](std::size_t block) {
      for (std::size_t n = block * block_nodes; n < (block + 1) * block_nodes; ++n) {
        const std::int32_t k = unknowns.number[2 * n + c];
        const std::int16_t by = grid.constraint(c, n);
        field[n] = k >= 0 ? values[k] : by >= 0 ? of_boundaries[static_cast<std::size_t>(by)][c] : 0.0;
      }
    });
  }
}

void read_field(const System& system, const NodalUnknowns& unknowns, Field component_0, double* values) {
  const double* field[2] = {system.grid.field(component_0),
                            system.grid.field(static_cast<Field>(static_cast<std::size_t>(component_0) + 1))};
  for (std::size_t k = 0; k < unknowns.size(); ++k)
    values[k] = field[unknowns.component[k]][unknowns.node[k]];
}

std::array<int, 2> place_of(const Grid& grid, std::size_t node) {
  const Block& block = grid.blocks()[node / block_nodes];
  const int within = static_cast<int>(node % block_nodes);
  return {block.column * block_side + within % block_side, block.row * block_side + within / block_side};
}

std::string describe_unknown(const System& system, const NodalUnknowns& u, std::size_t unknown) {
  const Grid& grid = system.grid;
  const auto [i, j] = place_of(grid, u.node[unknown]);
  const double mean = std::accumulate(u.mass.begin(), u.mass.end(), 0.0) / static_cast<double>(u.size());
  const char* axes[2] = {system.axisymmetric ? "r" : "x", system.axisymmetric ? "z" : "y"};
  return fmt::format("{} of the node at ({:.6g}, {:.6g}) m, mass {:.3g} of the mean",
                     axes[u.component[unknown]], i * grid.cell(), j * grid.cell(), u.mass[unknown] / mean);
}

}  // namespace vitrum::mpm
