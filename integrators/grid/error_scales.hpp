#pragma once
#include <optional>

#include "mpm/system.hpp"

namespace vitrum {

/// What an error is measured against. Tolerances are relative to these.
struct ErrorScales {
  double velocity = 0.0;  ///< m/s
  double strain = 0.0;    ///< 1
  double length = 0.0;    ///< m, the cell
};

/// Scales given by a scene; what is absent follows from the bodies.
struct GivenScales {
  std::optional<double> velocity, strain;
};

/// strain: the least elastic limit of all materials. velocity: the largest of the initial speeds of
/// particles, of prescribed boundary velocities, and of wave speed x strain scale.
ErrorScales error_scales(const System& system, const GivenScales& given);

/// Energy of all bodies at a velocity (and the strain of its wave) of `tolerance` times the scale.
double tolerated_energy(const System& system, const ErrorScales& scales, double tolerance);

}  // namespace vitrum
