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
  explicit EnergyLedger(const EnergyTotals& totals) : totals_(totals) {}

  /// Enters what system.record says of the last step.
  void book(const System& system);

  const EnergyTotals& totals() const { return totals_; }
  /// (kinetic + |elastic|) / (initial + positive external work); 1 while there is no energy to compare with.
  double growth() const;

 private:
  EnergyTotals totals_;
};

/// Totals in the joules that files show: per radian becomes whole body.
EnergyTotals scaled(const EnergyTotals& totals, double factor);

}  // namespace vitrum
