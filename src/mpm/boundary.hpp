#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "mpm/load_function.hpp"

namespace vitrum::mpm {

/// Rows (or columns) of nodes, counted from the origin; as doubles, since there may be no first or last one.
struct Rows {
  double first, last;
  bool any() const { return first <= last; }
  /// Cells from a place (cells from the origin) to the nearest of them; 0 between the first and the last.
  double distance(double place) const { return std::max({first - place, place - last, 0.0}); }
};
/// Those between two coordinates (m) or within rounding of them.
Rows rows_between(double min, double max, double cell);

/// A velocity component over time.
struct Drive {
  std::shared_ptr<const LoadFunction> velocity;
  double top_speed = 0.0;  ///< m/s
  /// Of a box that moves: its nodes are shifted by `cells` from a time (s) on.
  struct Shift {
    double time, cells;
  };
  std::vector<Shift> shifts{};
};
/// Finds the top speed and, for a box that moves, the shifts of a component between two times (s).
Drive drive_of(std::shared_ptr<const LoadFunction> velocity, bool moves, double from, double to, double cell);

/// A box of nodes with held or prescribed velocity components. A box that moves holds the nodes of its start,
/// shifted by its way rounded to whole cells: it is never further from its place than half a cell.
struct Boundary {
  std::string name;
  std::array<double, 2> min, max;  ///< m, at the time `since`
  std::array<bool, 2> fixed;
  std::array<double, 2> velocity;  ///< m/s; of a component with a drive: the present one (mpm/loads.hpp)
  bool moves = true;               ///< with its velocity
  double since = 0.0;              ///< s
  int priority = 0;      ///< of the boundaries that hold a component of a node, one with the largest acts
  bool mirrors = false;  ///< its faces are planes of symmetry (docs/theory/boundaries.md)
  std::array<std::shared_ptr<const Drive>, 2> drive{};  ///< null: the velocity is constant
  /// Of components with a drive: m/s when the step ends, m/s^2.
  std::array<double, 2> velocity_after{}, acceleration{};

  double end_velocity(std::size_t c) const { return drive[c] ? velocity_after[c] : velocity[c]; }
  double top_speed(std::size_t c) const { return drive[c] ? drive[c]->top_speed : std::abs(velocity[c]); }
  /// Way along a component's axis between two times (s), m.
  double way(std::size_t c, double from, double to) const {
    return drive[c] ? integral(*drive[c]->velocity, from, to) : (to - from) * velocity[c];
  }
  /// Whether a component's velocity is another's at all times.
  bool drives_as(const Boundary& other, std::size_t c) const {
    if (!drive[c] || !other.drive[c]) return drive[c] == other.drive[c] && velocity[c] == other.velocity[c];
    return drive[c]->velocity == other.drive[c]->velocity;
  }

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
  bool is_in_motion(std::size_t component) const {
    return moves && !drive[component] && velocity[component] != 0.0;
  }
  double time_of(std::size_t component, double cells, double cell) const;
  double cells_gone(std::size_t component, double time, double cell) const;
};

}  // namespace vitrum::mpm
