#include "mpm/loads.hpp"

#include <algorithm>

#include "mpm/tractions.hpp"

namespace vitrum::mpm {
namespace {

void set_gravity(System& system, double time) {
  for (std::size_t c = 0; c < 2; ++c)
    if (const auto& g = system.gravity_over_time[c]) system.gravity[c] = g->at(time);
}

/// Calls f(boundary, component, velocity over time) for all that are driven.
template <class F>
void for_driven(System& system, F&& f) {
  for (Boundary& wall : system.grid.boundaries())
    for (std::size_t c = 0; c < 2; ++c)
      if (wall.drive[c]) f(wall, c, *wall.drive[c]->velocity);
}

}  // namespace

bool has_gravity(const System& system) {
  return system.gravity[0] != 0.0 || system.gravity[1] != 0.0 || system.gravity_over_time[0] ||
         system.gravity_over_time[1];
}

bool drives(const System& system) {
  return std::ranges::any_of(system.grid.boundaries(),
                             [](const Boundary& wall) { return wall.drive[0] || wall.drive[1]; });
}

void set_loads_of_step(System& system, double duration) {
  set_gravity(system, system.time);
  for_driven(system, [&](Boundary& wall, std::size_t c, const LoadFunction& velocity) {
    wall.velocity[c] = velocity.at(system.time - 0.5 * duration);
    wall.velocity_after[c] = velocity.at(system.time + 0.5 * duration);
    wall.acceleration[c] = (wall.velocity_after[c] - wall.velocity[c]) / duration;
  });
}

void set_loads(System& system, double time, double until, Accelerations accelerations) {
  set_gravity(system, time);
  for_driven(system, [&](Boundary& wall, std::size_t c, const LoadFunction& velocity) {
    wall.velocity[c] = wall.velocity_after[c] = velocity.at(time);
    wall.acceleration[c] = accelerations == Accelerations::taken ? velocity.rate(time, until) : 0.0;
  });
}

OfBoundaries boundary_velocities(const System& system) {
  OfBoundaries list;
  for (const Boundary& wall : system.grid.boundaries()) list.push_back(wall.velocity);
  return list;
}

OfBoundaries boundary_ways(const System& system, double from, double to) {
  OfBoundaries list;
  for (const Boundary& wall : system.grid.boundaries())
    list.push_back({wall.way(0, from, to), wall.way(1, from, to)});
  return list;
}

double next_load_change(const System& system) {
  double next = system.grid.next_boundary_shift(system.time);
  if (system.tractions) next = std::min(next, system.tractions->next_kink(system.time));
  for (const auto& g : system.gravity_over_time)
    if (g) next = std::min(next, g->next_kink(system.time));
  for (const Boundary& wall : system.grid.boundaries())
    for (const auto& drive : wall.drive)
      if (drive) next = std::min(next, drive->velocity->next_kink(system.time));
  return next;
}

}  // namespace vitrum::mpm
