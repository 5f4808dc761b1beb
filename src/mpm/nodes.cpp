#include "mpm/nodes.hpp"

#include <algorithm>
#include <limits>

#include "mpm/loads.hpp"
#include "mpm/transfer.hpp"

namespace vitrum::mpm {
namespace {

double prescribed(const Grid& grid, std::size_t component, std::int16_t by, bool after) {
  if (by == Constraint::axis) return 0.0;
  const Boundary& wall = grid.boundaries()[static_cast<std::size_t>(by)];
  return after ? wall.end_velocity(component) : wall.velocity[component];
}

/// Sets the held components of a block's nodes in `field` (its component 0; component 1 follows). after: to
/// the velocities of the step's end.
void impose(Grid& grid, std::size_t block, Field component_0, bool after) {
  for (std::size_t component = 0; component < 2; ++component) {
    double* velocity = grid.field(static_cast<Field>(static_cast<std::size_t>(component_0) + component));
    for (std::size_t n = block * block_nodes; n < (block + 1) * block_nodes; ++n) {
      const std::int16_t by = grid.constraint(component, n);
      if (by != Constraint::free) velocity[n] = prescribed(grid, component, by, after);
    }
  }
}

/// Mass below which a node counts as empty (what reaches it has underflowed).
constexpr double empty = std::numeric_limits<double>::min();

}  // namespace

bool has_external_work(const System& system) {
  return has_gravity(system) || system.tractions ||
         std::ranges::any_of(system.grid.boundaries(), [](const Boundary& wall) {
           return wall.drive[0] || wall.drive[1] || wall.velocity[0] != 0.0 || wall.velocity[1] != 0.0;
         });
}

BlockVector block_vector(const Grid& grid, std::size_t block, Field component_0) {
  const auto component = [&](std::size_t c) {
    return grid.field(static_cast<Field>(static_cast<std::size_t>(component_0) + c)) + block * block_nodes;
  };
  return {component(0), component(1)};
}

void project_block(Grid& grid, std::size_t block, const BlockVector& momentum, bool after) {
  const std::size_t first = block * block_nodes;
  const double *mass = grid.field(Field::mass) + first, *p0 = momentum[0], *p1 = momentum[1];
  double *v0 = grid.field(Field::velocity_0) + first, *v1 = grid.field(Field::velocity_1) + first;
#pragma GCC ivdep
  for (std::size_t n = 0; n < block_nodes; ++n) {
    const double per_mass = mass[n] > empty ? 1.0 / mass[n] : 0.0;
    v0[n] = p0[n] * per_mass;
    v1[n] = p1[n] * per_mass;
  }
  if (grid.blocks()[block].constrained) impose(grid, block, Field::velocity_0, after);
}

void accelerate_block(Grid& grid, std::size_t block, const BlockVector& force,
                      const std::array<double, 2>& gravity, double duration) {
  const std::size_t first = block * block_nodes;
  const double *mass = grid.field(Field::mass) + first, *f0 = force[0], *f1 = force[1];
  const double *v0 = grid.field(Field::velocity_0) + first, *v1 = grid.field(Field::velocity_1) + first;
  double *w0 = grid.field(Field::new_velocity_0) + first, *w1 = grid.field(Field::new_velocity_1) + first;
  const double fall0 = duration * gravity[0], fall1 = duration * gravity[1];
#pragma GCC ivdep
  for (std::size_t n = 0; n < block_nodes; ++n) {
    const bool filled = mass[n] > empty;
    const double scale = filled ? duration / mass[n] : 0.0;
    w0[n] = v0[n] + scale * f0[n] + (filled ? fall0 : 0.0);
    w1[n] = v1[n] + scale * f1[n] + (filled ? fall1 : 0.0);
  }
  if (grid.blocks()[block].constrained) impose(grid, block, Field::new_velocity_0, true);
}

double external_power(const System& system, std::size_t block, const BlockVector& force, Field from,
                      Field to) {
  const Grid& grid = system.grid;
  const double* mass = grid.field(Field::mass) + block * block_nodes;
  const BlockVector v = block_vector(grid, block, from), w = block_vector(grid, block, to),
                    momentum =
                        grid.keeps_sums() ? block_vector(grid, block, Field::momentum_0) : BlockVector{};
  double power = 0.0;
  for (std::size_t c = 0; c < 2; ++c)
    for (std::size_t n = 0; n < block_nodes; ++n) {
      const double mean = 0.5 * (v[c][n] + w[c][n]), weight = mass[n] * system.gravity[c];
      power += weight * mean;
      if (const std::int16_t by = grid.constraint(c, block * block_nodes + n); by >= 0) {
        const double a = grid.boundaries()[static_cast<std::size_t>(by)].acceleration[c];
        power -= (force[c][n] + weight - mass[n] * a) * mean;
        if (a != 0.0) power += a * (momentum[c][n] - mass[n] * v[c][n]);
      }
    }
  return power;
}

namespace {

double external_power_of_all(const System& system, Field from, Field to) {
  double power = 0.0;
  if (has_external_work(system))
    for (std::size_t block = 0; block < system.grid.blocks().size(); ++block)
      power += external_power(system, block, block_vector(system.grid, block, Field::force_0), from, to);
  return power;
}

}  // namespace

void project_velocities(System& system) {
  system.team->for_each_chunk(system.grid.blocks().size(), [&](std::size_t block) {
    project_block(system.grid, block, block_vector(system.grid, block, Field::momentum_0));
  });
}

double accelerate(System& system) {
  Grid& grid = system.grid;
  const double* mass = grid.field(Field::mass);
  for (std::size_t c = 0; c < 2; ++c) {
    const double* force = grid.field(c == 0 ? Field::force_0 : Field::force_1);
    double* a = grid.field(c == 0 ? Field::acceleration_0 : Field::acceleration_1);
    system.team->for_each_chunk(grid.blocks().size(), [&](std::size_t block) {
      for (std::size_t n = block * block_nodes; n < (block + 1) * block_nodes; ++n) {
        const std::int16_t by = grid.constraint(c, n);
        a[n] = by >= 0 ? grid.boundaries()[static_cast<std::size_t>(by)].acceleration[c]
               : mass[n] > empty && by == Constraint::free ? force[n] / mass[n] + system.gravity[c]
                                                           : 0.0;
      }
    });
  }
  return external_power_of_all(system, Field::velocity_0, Field::velocity_0);
}

}  // namespace vitrum::mpm
