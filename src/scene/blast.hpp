#pragma once
#include <memory>
#include <optional>
#include <string>

#include "mpm/load_function.hpp"
#include "scene/scene.hpp"

namespace vitrum {

/// A modified Friedlander pulse: p (1 - s) exp(-decay s), s = (t - arrival) / duration in [0, 1], else 0.
struct Pulse {
  double pressure;  ///< Pa
  double duration;  ///< s
  double decay;
  double arrival;  ///< s

  double at(double time) const;
  /// Pa s.
  double impulse() const;
};

/// The scaled distances, m / kg^(1/3), that the fits are for.
inline constexpr double least_scaled_distance = 0.2, largest_scaled_distance = 40.0;

/// What a hemispherical charge of TNT on the ground does to a surface that its wave meets head-on: reflected
/// pressure, duration and arrival by M. M. Swisdak, Simplified Kingery Airblast Calculations (1994), fits of
/// the curves of Kingery and Bulmash (1984); the decay is that of the reflected impulse of the same fits.
/// charge: kg; standoff: m, at scaled distances from least_ to largest_scaled_distance.
Pulse blast_pulse(double charge, double standoff);
/// The reflected impulse of the fits, Pa s.
double reflected_impulse(double charge, double standoff);

/// The pulse of a traction that is one.
std::optional<Pulse> pulse_of(const TractionDefinition& traction);

/// A pulse as a load.
std::shared_ptr<const mpm::LoadFunction> pulse_function(const Pulse& pulse);

}  // namespace vitrum
