#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mpm/particles.hpp"

namespace vitrum::mpm {

/// What neighbours of a body agree on: a quantity of its particles averaged over what nodes see, by volume,
/// (S q)_p = sum_i N_i(x_p) sum_q V_q N_i(x_q) q_q / sum_q V_q N_i(x_q), N the hats of the grid's cells
/// whatever the scene's shape functions are. S keeps uniform q and sum V q; all its eigenvalues are in [0,
/// 1], as a matrix that volumes make symmetric: near 1 for what many cells share, near 0 for what differs
/// within a cell.
class CellAverage {
 public:
  /// counted: by particle, whether it takes part; others have no weight, and 0 as their average.
  CellAverage(const Body& body, double cell, const std::vector<char>& counted);

  /// (1 - S)^power q, of the particles that take part; 0 elsewhere.
  std::vector<double> differences(std::vector<double> quantity, int power) const;

 private:
  struct Corners {
    std::array<std::uint32_t, 4> node;
    std::array<double, 4> value;
  };
  std::vector<Corners> corners_;      ///< by particle
  std::vector<double> volume_;        ///< m^3 (per radian or per metre); 0: takes no part
  std::vector<std::uint32_t> order_;  ///< particles by identity, so that sums do not depend on their places
  std::vector<double> node_volume_;
};

}  // namespace vitrum::mpm
