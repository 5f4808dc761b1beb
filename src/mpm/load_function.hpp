#pragma once
#include <array>
#include <limits>

namespace vitrum::mpm {

/// A load over time and place. Evaluated a few times a step, by one thread, never in a loop over particles.
class LoadFunction {
 public:
  virtual ~LoadFunction() = default;
  /// At a time (s) and a place (m).
  virtual double at(double time, const std::array<double, 2>& place = {}) const = 0;
  /// Its rate of change, 1/s. until: no kink lies between the present and this time (s), at which one may
  /// lie. A jump has no rate.
  virtual double rate(double time, double until) const = 0;
  /// The first time after `time` at which the rate may jump, if it is known; infinite: none.
  virtual double next_kink(double /*time*/) const { return std::numeric_limits<double>::infinity(); }
};

/// Integral over time, to about twelve digits; jumps may lie anywhere.
double integral(const LoadFunction& load, double from, double to);

}  // namespace vitrum::mpm
