#pragma once
#include <cstdint>
#include <vector>

#include "mpm/storage.hpp"

namespace vitrum::test {

/// Puts the particle at place order[i] at place i, with all that it keeps from step to step.
inline void reorder(Particles& particles, const std::vector<std::uint32_t>& order) {
  mpm::for_each_column(particles, [&](auto& column) {
    const auto old = column;
    for (std::size_t i = 0; i < column.size(); ++i) column[i] = old[order[i]];
  });
}

}  // namespace vitrum::test
