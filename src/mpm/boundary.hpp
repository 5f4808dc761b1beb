#pragma once
#include <array>
#include <limits>
#include <string>

namespace vitrum::mpm {

/// Rows (or columns) of nodes, counted from the origin; as doubles, since there may be no first or last one.
struct Rows {
  double first, last;
  bool any() const { return first <= last; }
};
/// Those between two coordinates (m) or within rounding of them.
Rows rows_between(double min, double max, double cell);

/// A box of nodes with held or prescribed velocity components. A box that moves holds the nodes of its start,
/// shifted by its way rounded to whole cells: it is never further from its place than half a cell.
struct Boundary {
  std::string name;
  std::array<double, 2> min, max;  ///< m, at the time `since`
  std::array<bool, 2> fixed;
  std::array<double, 2> velocity;  ///< m/s
  bool moves = true;               ///< with its velocity
  double since = 0.0;              ///< s
  int priority = 0;      ///< of the boundaries that hold a component of a node, one with the largest acts
  bool mirrors = false;  ///< its faces are planes of symmetry (docs/theory.md 2.1)

  /// Whole cells by which the nodes it holds are shifted at `time` (s) along a component's axis.
  double shift(std::size_t component, double time, double cell) const;
  /// The first time after `time` at which the shift changes; infinite: never.
  double next_shift(double time, double cell) const;
  /// The nodes it holds along a component's axis, shifted by so many cells.
  Rows rows(std::size_t component, double shifted, double cell) const {
    const Rows at_start = rows_between(min[component], max[component], cell);
    return {at_start.first + shifted, at_start.last + shifted};
  }

 private:
  bool is_in_motion(std::size_t component) const { return moves && velocity[component] != 0.0; }
  double time_of(std::size_t component, double cells, double cell) const;
  double cells_gone(std::size_t component, double time, double cell) const;
};

}  // namespace vitrum::mpm
