#include "mpm/boundary.hpp"

#include <algorithm>
#include <cmath>

namespace vitrum::mpm {

Rows rows_between(double min, double max, double cell) {
  constexpr double slack = 1e-9;
  return {std::ceil(min / cell - slack), std::floor(max / cell + slack)};
}

/// When the box has gone half a cell more than `cells`: then its nodes are shifted by one more.
double Boundary::time_of(std::size_t component, double cells, double cell) const {
  return since + (cells + 0.5) * cell / std::abs(velocity[component]);
}

/// The number of such times up to `time`, so that shift and next_shift agree to the last bit.
double Boundary::cells_gone(std::size_t component, double time, double cell) const {
  constexpr double farthest = 1e15;  // beyond, doubles do not count cells
  double cells =
      std::clamp(std::floor(std::abs(velocity[component]) * (time - since) / cell + 0.5), 0.0, farthest);
  if (time_of(component, cells, cell) <= time) cells += 1.0;
  if (cells > 0.0 && time_of(component, cells - 1.0, cell) > time) cells -= 1.0;
  return cells;
}

double Boundary::shift(std::size_t component, double time, double cell) const {
  return is_in_motion(component) ? std::copysign(cells_gone(component, time, cell), velocity[component])
                                 : 0.0;
}

double Boundary::next_shift(double time, double cell) const {
  double next = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < 2; ++c) {
    if (!is_in_motion(c)) continue;
    const double change = time_of(c, cells_gone(c, time, cell), cell);
    if (change > time) next = std::min(next, change);
  }
  return next;
}

}  // namespace vitrum::mpm
