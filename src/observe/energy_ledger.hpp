#pragma once
#include "observe/energy_totals.hpp"
#include "observe/observer.hpp"
#include "scene/scene.hpp"

namespace vitrum {

/// Elastic energy stored in the particles of a body, or in all, now, J (per radian or per metre).
double stored_energy(const Body& body);
double stored_energy(const System& system);

/// Books the energies of a run, step by step; fills energy.csv a thousand times between start and end.
class EnergyLedger final : public Observer {
 public:
  static constexpr Column columns[] = {
      {"time", "s", "simulated time"},
      {"step", "1", "time steps taken so far"},
      {"kinetic", "J", "kinetic energy", true},
      {"elastic", "J", "stored elastic energy", true},
      {"plastic", "J", "dissipated by plastic flow so far", true},
      {"damage", "J", "dissipated by damage so far", true},
      {"fracture", "J", "dissipated by decohesion so far", true},
      {"external", "J", "work of gravity, tractions and prescribed velocities so far", true},
      {"residual", "J", "initial + external - all others: what the numerics made (negative) or lost", true},
      {"contact", "J", "stored between bodies", true},
      {"friction", "J", "dissipated by friction between bodies so far", true},
      {"filtered", "J", "removed by the filters so far", true},
      {"removed", "J", "gone with particles that left so far; only where `decohesion.separated` is `removed`",
       true}};
  static constexpr TableInfo table_info{"energy", "the energy account, a thousand rows between start and end",
                                        columns};
  static std::unique_ptr<Observer> make(const Scene& scene, const System& system);

  /// Opens the account with the system's present kinetic and elastic energy.
  explicit EnergyLedger(const System& system);
  /// Continues an account.
  EnergyLedger(const System& system, const EnergyTotals& totals);

  void step(const System& system, double duration) override;
  void tell(const System& system) override;
  void declare(const System& system, std::vector<Quantity>& quantities) const override;
  void save(Archive& archive) const override;
  void restore(const Archive& archive) override;
  Table* table() override { return &table_; }

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
  static TableInfo table_of(bool removes);

  bool removes_;  ///< particles may leave: the account has one entry more
  Table table_;
  EnergyTotals totals_;
  double driving_ = 0.0;  // J (per radian or per metre)
};

/// Totals in the joules that files show: per radian becomes whole body.
EnergyTotals scaled(const EnergyTotals& totals, double factor);

}  // namespace vitrum
