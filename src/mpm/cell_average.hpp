#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <numeric>
#include <vector>

#include "mpm/particles.hpp"
#include "parallel/thread_team.hpp"

namespace vitrum::mpm {

/// What neighbours of a body agree on: a quantity of its particles averaged over what nodes see, by volume,
/// (S q)_p = sum_i N_i(x_p) sum_q V_q N_i(x_q) q_q / sum_q V_q N_i(x_q), N the hats of the grid's cells
/// whatever the scene's shape functions are. S keeps uniform q and sum V q; all its eigenvalues are in [0,
/// 1], as a matrix that volumes make symmetric: near 1 for what many cells share, near 0 for what differs
/// within a cell. Cells add up their own particles by identity, and nodes the four cells around them, so that
/// sums depend neither on threads nor on how particles are stored.
class CellAverage {
 public:
  /// counted: by particle, whether it takes part; others have no weight, and 0 as their average.
  CellAverage(parallel::ThreadTeam& team, const Body& body, double cell, const std::vector<char>& counted);

  /// (1 - S)^power q, of the particles that take part; 0 elsewhere.
  std::vector<double> differences(std::vector<double> quantity, int power) const;

  /// The sum of f(particle), called on all threads, over those that take part.
  template <class F>
  double sum(F&& f) const {
    std::vector<double> of_cell(cells_.size(), 0.0);
    for_cells([&](std::size_t c) {
      for (std::uint32_t k = cells_[c].first; k < cells_[c].last; ++k) of_cell[c] += f(order_[k].particle);
    });
    return std::accumulate(of_cell.begin(), of_cell.end(), 0.0);
  }

 private:
  struct InCell {
    std::array<double, 2> cell;  ///< column and row: whole, but doubles, as in mpm/near.hpp
    std::uint32_t identity, particle;
    auto operator<=>(const InCell&) const = default;
  };
  struct Cell {
    std::uint32_t first, last;           ///< of order_
    std::array<std::int32_t, 9> around;  ///< the cell at (a, b) in 3 (b + 1) + a + 1; -1: none
  };
  /// What cells hold for their corners (left and right below, left and right above).
  using Corners = std::array<double, 4>;

  void sort();
  void find_cells();
  Corners weights(std::uint32_t k) const;
  /// Of all cells that meet there.
  Corners at_corners(const Cell& cell, const std::vector<Corners>& held) const;
  template <class F>
  void for_cells(F&& f) const {
    constexpr std::size_t most = 64;
    team_.for_each_chunk((cells_.size() + most - 1) / most, [&](std::size_t n) {
      for (std::size_t c = n * most; c < std::min(cells_.size(), (n + 1) * most); ++c) f(c);
    });
  }

  parallel::ThreadTeam& team_;
  std::vector<InCell> order_;                 ///< the particles that take part
  std::vector<std::array<double, 2>> place_;  ///< of these in their cells, [0, 1)
  std::vector<double> volume_;                ///< of these, m^3 (per radian or per metre)
  std::vector<Cell> cells_;
  std::vector<Corners> corner_volume_;  ///< by cell, of all cells that meet at its corners
  std::size_t size_;                    ///< particles of the body
};

}  // namespace vitrum::mpm
