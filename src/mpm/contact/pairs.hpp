#pragma once
#include <span>
#include <utility>
#include <vector>

#include "mpm/contact/patch.hpp"

namespace vitrum::mpm {

/// Finds places of two bodies that are near each other.
class PairSearch {
 public:
  /// Calls found(i, j) for a[i] and b[j] that are no further than `reach` (m) apart along both axes;
  /// by rising i, then j, whatever is found otherwise. Places are looked through in the order along the
  /// longer side of where the two bodies are both.
  template <class Found>
  void find(std::span<const Vector> a, std::span<const Vector> b, double reach, Found&& found) {
    list(a, b, reach);
    for (const auto& [i, j] : pairs_) found(i, j);
  }

 private:
  void list(std::span<const Vector> a, std::span<const Vector> b, double reach);

  std::vector<std::pair<double, std::uint32_t>> in_a_, in_b_;  // coordinate along the axis, and which
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs_;
};

}  // namespace vitrum::mpm
