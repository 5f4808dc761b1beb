#pragma once
#include <optional>
#include <string>

#include "analysis/energy_ledger.hpp"
#include "integrators/grid/critical_step.hpp"

namespace vitrum::app {

/// Stops a run that has become unstable.
class Watchdog {
 public:
  /// max_growth: bound on (kinetic + |elastic|) / (initial + positive external work), EnergyLedger::growth;
  /// infinite: only values that are not finite stop.
  Watchdog(double max_growth, StepScheme scheme) : max_growth_(max_growth), scheme_(scheme) {}

  /// A message that names time, particle, step and remedy when the last step, `step` seconds long, was one
  /// too many.
  std::optional<std::string> look(const System& system, const EnergyLedger& ledger, double step) const;
  /// The same text for a computation that failed otherwise.
  std::string describe(const System& system, const std::string& cause, double step) const;

 private:
  double max_growth_;
  StepScheme scheme_;
};

}  // namespace vitrum::app
