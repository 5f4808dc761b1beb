#pragma once
#include <algorithm>
#include <cmath>
#include <compare>
#include <cstdint>
#include <span>
#include <vector>

#include "tensor/columns.hpp"

namespace vitrum::mpm {

/// A point in its square. Coordinates of squares are whole, but doubles: the last step of a run that blows up
/// throws particles farther than integers count.
struct InSquare {
  double column, row;
  std::uint32_t point;
  auto operator<=>(const InSquare&) const = default;
};

/// Calls found(i, j), j < i, once for every two of the points `which` that are no further than `reach` (m)
/// apart. position: of all points, m.
template <class Found>
void find_near(std::span<const std::uint32_t> which, const VectorColumns& position, double reach,
               Found&& found) {
  std::vector<InSquare> order;
  for (const std::uint32_t i : which)
    order.push_back({std::floor(position[0][i] / reach), std::floor(position[1][i] / reach), i});
  std::sort(order.begin(), order.end(), [](const InSquare& a, const InSquare& b) { return a < b; });
  for (const InSquare& home : order)
    for (const double beside : {-1.0, 0.0, 1.0}) {
      // The squares of that column from the one below to the one above follow each other.
      auto other =
          std::lower_bound(order.begin(), order.end(), InSquare{home.column + beside, home.row - 1.0, 0});
      for (; other != order.end() && other->column == home.column + beside && other->row <= home.row + 1.0;
           ++other) {
        const std::uint32_t i = home.point, j = other->point;
        if (j < i && std::hypot(position[0][i] - position[0][j], position[1][i] - position[1][j]) <= reach)
          found(i, j);
      }
    }
}

}  // namespace vitrum::mpm
