#pragma once
#include <optional>
#include <string>

#include "integrators/grid/grid_integrator.hpp"
#include "observe/energy_ledger.hpp"

namespace vitrum::app {

/// Stops a run that has become unstable.
class Watchdog {
 public:
  /// max_growth: bound on (kinetic + |elastic|) / (initial + positive external work), EnergyLedger::growth;
  /// infinite: only values that are not finite stop. integrator: knows a remedy; must outlive the watchdog.
  Watchdog(double max_growth, const GridIntegrator& integrator)
      : max_growth_(max_growth), integrator_(integrator) {}

  /// A message that names time, particle, step and remedy when the last step, `step` seconds long, was one
  /// too many.
  std::optional<std::string> look(const System& system, const EnergyLedger& ledger, double step) const;
  /// Time, step, `cause`, and the fastest particle.
  static std::string describe(const System& system, const std::string& cause);

 private:
  double max_growth_;
  const GridIntegrator& integrator_;
};

}  // namespace vitrum::app
