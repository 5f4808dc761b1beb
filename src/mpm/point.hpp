#pragma once
#include "mpm/particles.hpp"

namespace vitrum::mpm {

/// The state of particle i of a body, and back. Its stress is that of the state.
PointState point_of(const Body& body, std::size_t i);
void put_point(const PointState& point, Body& body, std::size_t i);

}  // namespace vitrum::mpm
