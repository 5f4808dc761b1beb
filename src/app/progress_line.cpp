#include "app/progress_line.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "app/demands.hpp"

namespace vitrum::app {
namespace {

constexpr std::size_t shortest_bar = 10, longest_bar = 30, frame = 3;  // brackets and a blank

std::string bar(double part, std::size_t length) {
  const double filled = std::clamp(part, 0.0, 1.0) * static_cast<double>(length);
  return fmt::format("[{:<{}}] ", std::string(static_cast<std::size_t>(filled), '#'), length);
}

/// Whole seconds: digits behind them would change at every drawing.
std::string time_left(double seconds) {
  return seconds < 60.0 ? fmt::format("{:.0f} s", seconds) : duration_text(seconds);
}

}  // namespace

std::string progress_line(const Standing& s, std::size_t columns) {
  constexpr std::array limits{"fixed step", "stability", "accuracy", "output", "remap"};
  // Numbers of constant width: a line that is drawn anew keeps its parts where they are.
  struct Part {
    std::string text;
    int rank;
  };
  const std::array parts{
      Part{fmt::format("{:3.0f} %", 100.0 * s.part), 0},
      Part{fmt::format("  {:>8} left", time_left(s.left)), 1},
      Part{fmt::format("  residual {:+.2f} %", 100.0 * s.energy.relative_residual()), 2},
      Part{fmt::format("  kinetic {:<7.4g} {}", s.energy.kinetic, s.energy_unit), 3},
      Part{fmt::format("  elastic {:<7.4g} {}", s.energy.elastic, s.energy_unit), 4},
      Part{fmt::format("  t = {:<9.4g} us", 1e6 * s.time), 6},
      Part{fmt::format("  steps {}", s.counters.steps), 7},
      Part{fmt::format("  dt = {:<9.4g} us", 1e6 * s.step), 8},
      Part{fmt::format("  limit: {:<10}", limits[static_cast<std::size_t>(s.counters.last_limit)]), 9},
      Part{fmt::format("  rejected {}", s.counters.rejected), 10},
  };
  constexpr int rank_of_bar = 5, ranks = 11;
  std::size_t left = columns;
  int shown = 0;  // ranks below
  bool has_bar = false;
  for (; shown < ranks; ++shown) {
    const auto part = std::ranges::find(parts, shown, &Part::rank);
    const std::size_t needed = shown == rank_of_bar ? shortest_bar + frame : part->text.size();
    if (needed > left) break;
    left -= needed;
    has_bar = has_bar || shown == rank_of_bar;
  }
  std::string line = has_bar ? bar(s.part, std::min(shortest_bar + left, longest_bar)) : "";
  for (const Part& part : parts)
    if (part.rank < shown) line += part.text;
  return line;
}

}  // namespace vitrum::app
