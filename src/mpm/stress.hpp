#pragma once
#include <array>
#include <vector>

#include "mpm/particles.hpp"

namespace vitrum::mpm {

/// Stress of a body's particles in the order of their columns, Pa, (rr, zz, tt, rz).
TensorColumns stress_of(const Body& body);

}  // namespace vitrum::mpm
