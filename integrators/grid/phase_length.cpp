#include "integrators/grid/phase_length.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace vitrum {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

double time_for(double way, double speed) {
  return speed > 0.0 ? way / speed : never;
}

/// Cells over which nodes act on a particle.
double reach(const System& system, const Body& body) {
  switch (system.grid.shape()) {
    case mpm::ShapeKind::linear:
      return 1.0;
    case mpm::ShapeKind::gimp:
      return 1.0 + body.particle_half_size / system.cell;
    case mpm::ShapeKind::cpgimp:
    case mpm::ShapeKind::bspline2:
      return 1.5;
  }
  return 1.5;
}

/// Cells between the nodes that a wall holds and the nearest particle of a body.
double distance(std::size_t wall, const Body& body, const System& system) {
  const auto& x = body.particles.position;
  double nearest = never;
  for (std::size_t i = 0; i < body.present(); ++i)
    nearest =
        std::min(nearest, cells_to_held(system.grid, wall, {x[0][i] / system.cell, x[1][i] / system.cell}));
  return nearest;
}

/// Largest speed of a body's particles towards a wall or away from it, m/s.
double speed_at(const mpm::Boundary& wall, const Body& body) {
  const Particles& p = body.particles;
  double fastest = 0.0;
  for (std::size_t c = 0; c < 2; ++c)
    if (wall.fixed[c])
      for (std::size_t i = 0; i < body.present(); ++i)
        fastest = std::max(fastest, std::abs(p.velocity[c][i] - wall.velocity[c]));
  return fastest;
}

/// What a wall that is about to take hold of a body or to let it go allows a phase. Shape functions wider
/// than a cell stop what comes with a speed v within sqrt(v/c) cells of their reach, and let go within as
/// much. A longer phase, whose shape functions stand still, would miss the one and weld in the other.
PhaseBounds bounds_at(std::size_t wall, const Body& body, const System& system, double travel) {
  constexpr double firm = 0.75;   // cells: what is so near cannot leave
  constexpr double share = 0.05;  // of the depth at which it is, or will be stopped
  const double away = distance(wall, body, system), gap = away - reach(system, body);
  if (away < firm || gap > travel) return {never, never};
  const double speed = speed_at(system.grid.boundaries()[wall], body);
  const double depth = std::max(std::sqrt(speed / body.material->wave_speed()), -gap);
  const double way = std::max(gap, share * depth);
  return {time_for(way * system.cell, speed), way};
}

}  // namespace

double cells_to_held(const mpm::Grid& grid, std::size_t boundary, const std::array<double, 2>& place) {
  const std::array<mpm::Rows, 2> rows{grid.held_rows(boundary, 0), grid.held_rows(boundary, 1)};
  if (!rows[0].any() || !rows[1].any()) return never;
  return std::max(rows[0].distance(place[0]), rows[1].distance(place[1]));
}

PhaseBounds phase_bounds(const System& system, const RemapSettings& remap) {
  double fastest = 0.0;
  for (const Body& body : system.bodies)
    for (std::size_t i = 0; i < body.particles.size; ++i)
      fastest = std::max(fastest, std::hypot(body.particles.velocity[0][i], body.particles.velocity[1][i]));
  // Held nodes may carry particles that do not know of their speed.
  for (const mpm::Boundary& wall : system.grid.boundaries())
    for (std::size_t c = 0; c < 2; ++c)
      if (wall.fixed[c]) fastest = std::max(fastest, wall.top_speed(c));
  PhaseBounds bounds{std::min(remap.duration, time_for(remap.travel * system.cell, fastest)), never};
  for (std::size_t wall = 0; wall < system.grid.boundaries().size(); ++wall)
    for (const Body& body : system.bodies) {
      const PhaseBounds here = bounds_at(wall, body, system, remap.travel);
      bounds.duration = std::min(bounds.duration, here.duration);
      bounds.way_at_walls = std::min(bounds.way_at_walls, here.way_at_walls);
    }
  return bounds;
}

}  // namespace vitrum
