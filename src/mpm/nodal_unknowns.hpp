#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mpm/system.hpp"

namespace vitrum::mpm {

/// The velocity components of nodes that are neither empty nor held, numbered in the order of the blocks.
struct NodalUnknowns {
  std::vector<std::uint32_t> node;      ///< by unknown
  std::vector<std::uint8_t> component;  ///< by unknown
  std::vector<double> mass;             ///< by unknown, kg (per radian or per metre)
  std::vector<std::int32_t> number;     ///< by 2 node + component; -1: no unknown

  std::size_t size() const { return node.size(); }
};

/// Numbers the unknowns of the grid's present masses (after Scatter::momentum).
void number_unknowns(const System& system, NodalUnknowns& unknowns);

/// Fills a vector field (its component 0; component 1 follows): unknowns from `values`, held components with
/// what is given of their boundaries, empty nodes with 0.
void fill_field(System& system, const NodalUnknowns& unknowns, const double* values,
                std::span<const std::array<double, 2>> of_boundaries, Field component_0);
/// The other way round: the unknowns of a field.
void read_field(const System& system, const NodalUnknowns& unknowns, Field component_0, double* values);

/// Column and row of a node, counted from the origin.
std::array<int, 2> place_of(const Grid& grid, std::size_t node);
/// Names an unknown: `r of node (0.01, 0.02) m, mass 1e-9 of the mean`.
std::string describe_unknown(const System& system, const NodalUnknowns& unknowns, std::size_t unknown);

}  // namespace vitrum::mpm
