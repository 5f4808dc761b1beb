#pragma once
#include <optional>

#include "analysis/energy_totals.hpp"
#include "mpm/system.hpp"

namespace vitrum {

/// Elastic energy stored in all particles now, J (per radian or per metre).
double stored_energy(const System& system);

/// Books the energies of a run, step by step.
class EnergyLedger {
 public:
  /// Opens the account with the system's present kinetic and elastic energy.
  explicit EnergyLedger(const System& system);
  /// Continues an account (resume).
  EnergyLedger(const System& system, const EnergyTotals& totals);

  /// Enters what system.record says of the last step.
  void book(const System& system);
  /// Takes the kinetic energy of the particles as they stand: a run that stops between steps may have moved
  /// them.
  void refresh_kinetic(const System& system);

  const EnergyTotals& totals() const { return totals_; }
  /// (kinetic + elastic) / (initial + positive external work + driving); 1 while there is no energy to
  /// compare with. driving: kinetic energy that all bodies would have at the largest prescribed speed;
  /// without it the first steps of a piston, whose work is booked to the first order of the step, would look
  /// like growth. allowance: energy that an integrator may make within its tolerance, J (per radian or per
  /// metre).
  double growth(double allowance = 0.0) const;

 private:
  EnergyTotals totals_;
  double driving_ = 0.0;  // J (per radian or per metre)
};

/// Totals in the joules that files show: per radian becomes whole body.
EnergyTotals scaled(const EnergyTotals& totals, double factor);

}  // namespace vitrum
