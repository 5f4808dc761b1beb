#include "analysis/energy_ledger.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mpm/point.hpp"
#include "mpm/transfer.hpp"

namespace vitrum {

double stored_energy(const System& system) {
  double sum = 0.0;
  for (const Body& body : system.bodies) {
    const Particles& p = body.particles;
    const double specific_volume = 1.0 / body.material->density();
    for (std::size_t i = 0; i < p.size; ++i)
      sum += p.mass[i] * specific_volume * body.material->stored_energy(mpm::point_of(body, i));
  }
  return sum;
}

EnergyLedger::EnergyLedger(const System& system, const EnergyTotals& totals) : totals_(totals) {
  double mass = 0.0, speed = 0.0;
  for (const Body& body : system.bodies)
    for (const double m : body.particles.mass) mass += m;
  for (const mpm::Boundary& wall : system.grid.boundaries())
    speed = std::max(speed, std::hypot(wall.velocity[0], wall.velocity[1]));
  driving_ = 0.5 * mass * speed * speed;
  const double falling = mass * std::hypot(system.gravity[0], system.gravity[1]) * system.cell;
  totals_.rounding = std::numeric_limits<double>::epsilon() * (driving_ + falling);
}

EnergyLedger::EnergyLedger(const System& system) : EnergyLedger(system, EnergyTotals{}) {
  totals_.kinetic = mpm::kinetic_energy(system);
  totals_.elastic = stored_energy(system);
  totals_.contact = system.record.contact;
  totals_.initial = totals_.kinetic + totals_.elastic + totals_.contact;
}

void EnergyLedger::book(const System& system) {
  const StepRecord& r = system.record;
  totals_.kinetic = r.kinetic;
  totals_.elastic = r.elastic;
  totals_.contact = r.contact;
  totals_.friction += r.friction;
  totals_.plastic += r.dissipated.plastic;
  totals_.damage += r.dissipated.damage;
  totals_.fracture += r.dissipated.fracture;
  totals_.snap_back += r.dissipated.snap_back;
  totals_.external += r.external_work;
  totals_.largest_work = std::max(totals_.largest_work, std::abs(totals_.external));
  if (totals_.initial > 0.0)
    totals_.max_growth = std::max(totals_.max_growth, (r.kinetic + r.elastic) / totals_.initial);
}

void EnergyLedger::refresh_kinetic(const System& system) {
  totals_.kinetic = mpm::kinetic_energy(system);
}

double EnergyLedger::growth(double allowance) const {
  const double available =
      totals_.initial + std::max(totals_.external, 0.0) + driving_ + totals_.rounding + allowance;
  const double present = totals_.kinetic + totals_.elastic;
  return available > least_energy ? present / available : (std::isfinite(present) ? 1.0 : present);
}

EnergyTotals scaled(const EnergyTotals& t, double factor) {
  EnergyTotals s = t;
  for (double EnergyTotals::*member :
       {&EnergyTotals::initial, &EnergyTotals::kinetic, &EnergyTotals::elastic, &EnergyTotals::plastic,
        &EnergyTotals::damage, &EnergyTotals::fracture, &EnergyTotals::snap_back, &EnergyTotals::contact,
        &EnergyTotals::friction, &EnergyTotals::external, &EnergyTotals::largest_work,
        &EnergyTotals::rounding})
    s.*member *= factor;
  return s;
}

}  // namespace vitrum
