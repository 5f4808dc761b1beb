#include "mpm/removal.hpp"

#include <algorithm>
#include <functional>
#include <utility>

#include "mpm/contact/contact.hpp"
#include "mpm/point.hpp"
#include "mpm/storage.hpp"

namespace vitrum::mpm {
namespace {

/// Those of a body that are to leave, by rising identity.
std::vector<std::uint32_t> leaving(const Body& body) {
  const std::vector<double>& leaves = body.particles.variables[*body.material->leaving_column()];
  std::vector<std::uint32_t> list;
  for (std::uint32_t i = 0; i < body.on_grid(); ++i)
    if (leaves[i] >= 1.0) list.push_back(i);
  std::ranges::sort(list, {}, [&](std::uint32_t i) { return body.particles.identity[i]; });
  return list;
}

/// Books what a particle has, and stops it.
void book(System& system, std::size_t n, std::uint32_t i) {
  Body& body = system.bodies[n];
  Particles& p = body.particles;
  StepRecord& record = system.record;
  const std::array place{p.position[0][i], p.position[1][i]}, velocity{p.velocity[0][i], p.velocity[1][i]};
  const double kinetic = 0.5 * p.mass[i] * (velocity[0] * velocity[0] + velocity[1] * velocity[1]),
               stored =
                   p.mass[i] / body.material->density() * body.material->stored_energy(point_of(body, i));
  record.kinetic -= kinetic, record.elastic -= stored, record.removed += kinetic + stored;
  record.left.push_back({n, p.identity[i], p.mass[i], place, velocity});
  for (std::vector<double>& v : p.velocity) v[i] = 0.0;
  for (std::vector<double>& e : p.elastic_strain) e[i] = 0.0;
}

/// Puts particles behind those that are present. The events of the step go with them.
void put_behind(System& system, std::size_t n, std::vector<std::uint32_t> list) {
  Body& body = system.bodies[n];
  std::ranges::sort(list, std::greater{});  // so that no place taken is one of those to come
  for (const std::uint32_t i : list) {
    const std::size_t last = body.present() - 1;
    for_each_column(body.particles, [&](auto& column) {
      if (!column.empty()) std::swap(column[i], column[last]);
    });
    for (BodyEvent& e : system.record.events)
      if (e.body == n && (e.particle == i || e.particle == last)) e.particle = e.particle == i ? last : i;
    ++body.removed;
  }
}

}  // namespace

bool removes(const Body& body) {
  return body.material->leaving_column().has_value();
}

bool removes(const System& system) {
  return std::ranges::any_of(system.bodies, [](const Body& body) { return removes(body); });
}

bool remove_particles(System& system) {
  bool any = false;
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    if (!removes(system.bodies[n])) continue;
    const std::vector<std::uint32_t> list = leaving(system.bodies[n]);
    if (list.empty()) continue;
    any = true;
    for (const std::uint32_t i : list) book(system, n, i);
    put_behind(system, n, list);
  }
  if (!any) return false;
  system.grid.note_sorted();
  system.grid_is_stale = true;
  if (system.contact) system.record.removed += system.contact->drop_removed(system);
  return true;
}

std::vector<double> removed_counts(const System& system) {
  std::vector<double> counts;
  for (const Body& body : system.bodies)
    if (removes(system)) counts.push_back(static_cast<double>(body.removed));
  return counts;
}

bool restore_removed(System& system, const std::vector<double>& counts) {
  if (counts.size() != (removes(system) ? system.bodies.size() : 0)) return false;
  for (std::size_t n = 0; n < counts.size(); ++n) {
    Body& body = system.bodies[n];
    const auto most = static_cast<double>(removes(body) ? body.particles.size : 0);
    if (!(counts[n] >= 0.0 && counts[n] <= most)) return false;
    body.removed = static_cast<std::size_t>(counts[n]);
  }
  return true;
}

double removed_mass(const Body& body) {
  double sum = 0.0;
  for (std::size_t i = body.present(); i < body.particles.size; ++i) sum += body.particles.mass[i];
  return sum;
}

}  // namespace vitrum::mpm
