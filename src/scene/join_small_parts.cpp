#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "scene/lattice_parts.hpp"

namespace vitrum {
namespace {

/// Areas that differ by less (relative) are equal: rounding must not choose among mirror images.
constexpr double rounding = 1e-6;

class Joining {
 public:
  explicit Joining(std::vector<LatticePart>& parts) : parts_(parts), gone_(parts.size(), false) {
    own_area_.reserve(parts.size());
    for (std::size_t i = 0; i < parts.size(); ++i) {
      own_area_.push_back(parts[i].area);
      if (parts[i].area < small_part) waiting_.emplace(parts[i].area, i);
    }
  }

  void run() {
    while (!waiting_.empty()) {
      const std::size_t part = waiting_.extract(waiting_.begin()).value().second;
      hand_over(part, largest(neighbours(part)));
    }
    std::size_t left = 0;
    for (std::size_t i = 0; i < parts_.size(); ++i)
      if (!gone_[i]) parts_[left++] = parts_[i];
    parts_.resize(left);
  }

 private:
  using Indices = std::set<std::size_t>;

  /// Those beside the part; where all of them have gone, those beside them, and so on.
  Indices neighbours(std::size_t part) const {
    Indices found, seen{part};
    for (Indices edge{part}; found.empty() && !edge.empty();) {
      Indices next;
      for (const std::size_t i : edge)
        for (const std::size_t other : beside(i))
          if (seen.insert(other).second) (gone_[other] ? next : found).insert(other);
      edge = std::move(next);
    }
    return found;
  }

  /// Up to four of the parts as they were at the start.
  Indices beside(std::size_t part) const {
    const std::int64_t row = parts_[part].row, column = parts_[part].column;
    const std::array<std::pair<std::int64_t, std::int64_t>, 4> sides{
        {{row - 1, column}, {row, column - 1}, {row, column + 1}, {row + 1, column}}};
    Indices found;
    for (const auto& side : sides) {
      const auto at = std::ranges::lower_bound(
          parts_, side, {}, [](const LatticePart& p) { return std::pair(p.row, p.column); });
      if (at != parts_.end() && std::pair(at->row, at->column) == side)
        found.insert(static_cast<std::size_t>(at - parts_.begin()));
    }
    return found;
  }

  Indices largest(const Indices& among) const {
    double most = 0.0;
    for (const std::size_t i : among) most = std::max(most, own_area_[i]);
    Indices found;
    for (const std::size_t i : among)
      if (own_area_[i] >= (1.0 - rounding) * most) found.insert(i);
    return found;
  }

  void hand_over(std::size_t part, const Indices& takers) {
    const LatticePart& from = parts_[part];
    const double share = 1.0 / static_cast<double>(takers.size());
    for (const std::size_t taker : takers) {
      LatticePart& to = parts_[taker];
      waiting_.erase({to.area, taker});
      to.area += share * from.area;
      to.moment[0] += share * (from.moment[0] + from.area * static_cast<double>(from.column - to.column));
      to.moment[1] += share * (from.moment[1] + from.area * static_cast<double>(from.row - to.row));
      if (to.area < small_part) waiting_.emplace(to.area, taker);
    }
    gone_[part] = !takers.empty();
  }

  std::vector<LatticePart>& parts_;
  std::vector<bool> gone_;
  std::vector<double> own_area_;  // before any was handed over: mirror images decide alike
  std::set<std::pair<double, std::size_t>> waiting_;  // small parts, by area
};

}  // namespace

void join_small_parts(std::vector<LatticePart>& parts) {
  Joining(parts).run();
}

}  // namespace vitrum
