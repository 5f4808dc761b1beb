#include "observe/energy_ledger.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "mpm/point.hpp"
#include "mpm/removal.hpp"
#include "mpm/transfer.hpp"

namespace vitrum {

namespace {

void add_stored_energy(const Body& body, double& sum) {
  const Particles& p = body.particles;
  const double specific_volume = 1.0 / body.material->density();
  for (std::size_t i = 0; i < p.size; ++i)
    sum += p.mass[i] * specific_volume * body.material->stored_energy(mpm::point_of(body, i));
}

}  // namespace

double stored_energy(const Body& body) {
  double sum = 0.0;
  add_stored_energy(body, sum);
  return sum;
}

double stored_energy(const System& system) {
  double sum = 0.0;
  for (const Body& body : system.bodies) add_stored_energy(body, sum);
  return sum;
}

TableInfo EnergyLedger::table_of(bool removes) {
  const std::span<const Column> all(columns);
  return {table_info.name, table_info.description, removes ? all : all.first(all.size() - 1)};
}

EnergyLedger::EnergyLedger(const System& system, const EnergyTotals& totals)
    : removes_(mpm::removes(system)), table_(table_of(removes_)), totals_(totals) {
  double mass = 0.0, speed = 0.0;
  for (const Body& body : system.bodies)
    for (const double m : body.particles.mass) mass += m;
  for (const mpm::Boundary& wall : system.grid.boundaries())
    speed = std::max(speed, std::hypot(wall.top_speed(0), wall.top_speed(1)));
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

std::unique_ptr<Observer> EnergyLedger::make(const Scene& scene, const System& system) {
  constexpr double rows = 1000.0;
  auto ledger = std::make_unique<EnergyLedger>(system);
  ledger->table_.cadence = Cadence(scene.start, (scene.end - scene.start) / rows, scene.start);
  ledger->table_.needs_particles = false;
  return ledger;
}

/// Enters what the record says of the last step.
void EnergyLedger::step(const System& system, double /*duration*/) {
  const StepRecord& r = system.record;
  totals_.kinetic = r.kinetic;
  totals_.elastic = r.elastic;
  totals_.contact = r.contact;
  totals_.friction += r.friction;
  totals_.filtered += r.filtered;
  totals_.removed += r.removed;
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

namespace {

/// Every number of an account, by name.
struct NamedEnergy {
  const char* name;
  double EnergyTotals::*member;
};
constexpr NamedEnergy energies[] = {
    {"energy.initial", &EnergyTotals::initial},     {"energy.kinetic", &EnergyTotals::kinetic},
    {"energy.elastic", &EnergyTotals::elastic},     {"energy.plastic", &EnergyTotals::plastic},
    {"energy.damage", &EnergyTotals::damage},       {"energy.fracture", &EnergyTotals::fracture},
    {"energy.snap_back", &EnergyTotals::snap_back}, {"energy.contact", &EnergyTotals::contact},
    {"energy.friction", &EnergyTotals::friction},   {"energy.filtered", &EnergyTotals::filtered},
    {"energy.external", &EnergyTotals::external},   {"energy.largest_work", &EnergyTotals::largest_work},
    {"energy.rounding", &EnergyTotals::rounding},   {"energy.removed", &EnergyTotals::removed}};
constexpr const char* growth_name = "energy.max_growth";  // a ratio

/// Those that an account has.
std::span<const NamedEnergy> entries(bool removes) {
  const std::span<const NamedEnergy> all(energies);
  return removes ? all : all.first(all.size() - 1);
}

}  // namespace

void EnergyLedger::save(Archive& archive) const {
  for (const auto& [name, member] : entries(removes_)) archive.put(name, totals_.*member);
  archive.put(growth_name, totals_.max_growth);
}

void EnergyLedger::restore(const Archive& archive) {
  for (const auto& [name, member] : entries(removes_)) totals_.*member = archive.number(name);
  totals_.max_growth = archive.number(growth_name);
}

void EnergyLedger::tell(const System& system) {
  const EnergyTotals e = scaled(totals_, whole_body(system));
  const auto tell = [&](const auto&... more) {
    table_.row(system.time, system.step_index, e.kinetic, e.elastic, e.plastic, e.damage, e.fracture,
               e.external, e.residual(), e.contact, e.friction, e.filtered, more...);
  };
  removes_ ? tell(e.removed) : tell();
}

void EnergyLedger::declare(const System& system, std::vector<Quantity>& quantities) const {
  const EnergyTotals e = scaled(totals_, whole_body(system));
  const char* unit = system.axisymmetric ? "J" : "J/m";
  const Quantity own[] = {
      {"kinetic", unit, "kinetic energy", e.kinetic},
      {"elastic", unit, "stored elastic energy", e.elastic},
      {"plastic", unit, "energy dissipated by plastic flow", e.plastic},
      {"damage", unit, "energy dissipated by damage", e.damage},
      {"fracture", unit, "energy dissipated by decohesion", e.fracture},
      {"contact", unit, "energy stored between bodies", e.contact},
      {"friction", unit, "energy dissipated by friction between bodies", e.friction},
      {"filtered", unit, "energy removed by the filters", e.filtered},
      {"external", unit, "work of gravity, tractions and prescribed velocities", e.external},
      {"residual", unit, "initial + external - all of the above: what the numerics made", e.residual()},
      {"max_growth", "1", "largest (kinetic + elastic) / initial so far", e.max_growth}};
  quantities.insert(quantities.end(), std::begin(own), std::end(own));
  if (removes_) quantities.push_back({"removed", unit, "energy gone with particles that left", e.removed});
}

EnergyTotals scaled(const EnergyTotals& t, double factor) {
  EnergyTotals s = t;
  for (const NamedEnergy& energy : energies) s.*energy.member *= factor;
  return s;
}

}  // namespace vitrum
