#include "mpm/boundary.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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
  if (moves && drive[component]) {
    const auto& shifts = drive[component]->shifts;
    const auto next = std::ranges::upper_bound(shifts, time, {}, &Drive::Shift::time);
    return next == shifts.begin() ? 0.0 : (next - 1)->cells;
  }
  return is_in_motion(component) ? std::copysign(cells_gone(component, time, cell), velocity[component])
                                 : 0.0;
}

double Boundary::next_shift(double time, double cell) const {
  double next = std::numeric_limits<double>::infinity();
  for (std::size_t c = 0; c < 2; ++c) {
    if (moves && drive[c]) {
      const auto& shifts = drive[c]->shifts;
      const auto after = std::ranges::upper_bound(shifts, time, {}, &Drive::Shift::time);
      if (after != shifts.end()) next = std::min(next, after->time);
    }
    if (!is_in_motion(c)) continue;
    const double change = time_of(c, cells_gone(c, time, cell), cell);
    if (change > time) next = std::min(next, change);
  }
  return next;
}

Drive drive_of(std::shared_ptr<const LoadFunction> velocity, bool moves, double from, double to,
               double cell) {
  Drive drive{std::move(velocity)};
  const LoadFunction& v = *drive.velocity;
  constexpr int intervals = 4096;
  double way = 0.0, cells = 0.0, last = from;
  const auto time_at = [&](int k) { return from + (to - from) * k / intervals; };
  drive.top_speed = std::abs(v.at(from));
  const auto go_to = [&](double time) {
    drive.top_speed = std::max(drive.top_speed, std::abs(v.at(time)));
    double gone = integral(v, last, time);
    // A row further each time the box has gone half a cell more; the instant by halving.
    while (moves && std::abs((way + gone) / cell - cells) > 0.5) {
      const double next = cells + std::copysign(1.0, (way + gone) / cell - cells),
                   half = 0.5 * (cells + next);
      double early = last, late = time;
      const bool onward = next > cells;
      for (int k = 0; k < 60; ++k) {
        const double middle = 0.5 * (early + late);
        const bool beyond = ((way + integral(v, last, middle)) / cell > half) == onward;
        (beyond ? late : early) = middle;
      }
      drive.shifts.push_back({late, next});
      cells = next;
    }
    way += gone, last = time;
  };
  for (int k = 1; k <= intervals; ++k) {
    for (double kink = v.next_kink(last); kink < time_at(k); kink = v.next_kink(kink)) go_to(kink);
    go_to(time_at(k));
  }
  return drive;
}

}  // namespace vitrum::mpm
