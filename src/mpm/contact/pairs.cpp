#include "mpm/contact/pairs.hpp"

#include <algorithm>
#include <limits>

namespace vitrum::mpm {
namespace {

struct Bounds {
  Vector min{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  Vector max{-std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};

  bool contain(const Vector& x) const {
    return x[0] >= min[0] && x[0] <= max[0] && x[1] >= min[1] && x[1] <= max[1];
  }
};

Bounds bounds_of(std::span<const Vector> places) {
  Bounds bounds;
  for (const Vector& x : places)
    for (std::size_t c = 0; c < 2; ++c)
      bounds.min[c] = std::min(bounds.min[c], x[c]), bounds.max[c] = std::max(bounds.max[c], x[c]);
  return bounds;
}

/// Where two bodies are both, or nearly.
Bounds common(const Bounds& a, const Bounds& b, double reach) {
  Bounds both;
  for (std::size_t c = 0; c < 2; ++c)
    both.min[c] = std::max(a.min[c], b.min[c]) - reach, both.max[c] = std::min(a.max[c], b.max[c]) + reach;
  return both;
}

}  // namespace

void PairSearch::list(std::span<const Vector> a, std::span<const Vector> b, double reach) {
  pairs_.clear();
  const Bounds both = common(bounds_of(a), bounds_of(b), reach);
  if (!(both.min[0] <= both.max[0] && both.min[1] <= both.max[1])) return;
  const std::size_t axis = both.max[0] - both.min[0] >= both.max[1] - both.min[1] ? 0 : 1, other = 1 - axis;
  const auto list_inside = [&](std::span<const Vector> places, auto& inside) {
    inside.clear();
    for (std::uint32_t i = 0; i < places.size(); ++i)
      if (both.contain(places[i])) inside.emplace_back(places[i][axis], i);
    std::sort(inside.begin(), inside.end());
  };
  list_inside(a, in_a_), list_inside(b, in_b_);
  auto first = in_b_.begin();
  for (const auto& [place, i] : in_a_) {
    while (first != in_b_.end() && first->first < place - reach) ++first;
    for (auto next = first; next != in_b_.end() && next->first <= place + reach; ++next)
      if (std::abs(b[next->second][other] - a[i][other]) <= reach) pairs_.emplace_back(i, next->second);
  }
  std::sort(pairs_.begin(), pairs_.end());
}

}  // namespace vitrum::mpm
