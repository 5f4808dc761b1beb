#pragma once
#include <array>
#include <optional>

#include "mpm/system.hpp"

namespace vitrum::app {

/// What an initial stress lacks of equilibrium without loads: force and moment of a mean section across r or
/// x (in axisymmetry the mean of radial and hoop stress). In equilibrium both vanish exactly, whatever the
/// body's shape: they are the work of the stress on a uniform strain and on a uniform bending.
struct StressBalance {
  double largest;  ///< Pa, largest stress component
  double force;    ///< N/m
  double moment;   ///< N, about the middle
};

/// Of a body; nothing: it has no stress.
std::optional<StressBalance> stress_balance(const System& system, const Body& body);

}  // namespace vitrum::app
