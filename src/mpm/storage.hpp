#pragma once
#include <cstdint>
#include <vector>

#include "mpm/particles.hpp"

namespace vitrum::mpm {

/// Puts the particle at place order[i] at place i, with all that it keeps from step to step.
void reorder(Particles& particles, const std::vector<std::uint32_t>& order);

}  // namespace vitrum::mpm
