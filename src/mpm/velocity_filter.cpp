#include "mpm/velocity_filter.hpp"

#include "mpm/centroids.hpp"
#include "mpm/transfer.hpp"

namespace vitrum::mpm {
namespace {

/// Nodal velocities from mass and momentum, held only where the axis is.
void project_freely(System& system) {
  Grid& grid = system.grid;
  system.team->for_each_chunk(grid.blocks().size(), [&](std::size_t block) {
    const double* mass = grid.field(Field::mass);
    for (std::size_t c = 0; c < 2; ++c) {
      const double* momentum = grid.field(c == 0 ? Field::momentum_0 : Field::momentum_1);
      double* velocity = grid.field(c == 0 ? Field::velocity_0 : Field::velocity_1);
      for (std::size_t n = block * block_nodes; n < (block + 1) * block_nodes; ++n)
        velocity[n] =
            mass[n] > 0.0 && grid.constraint(c, n) != Constraint::axis ? momentum[n] / mass[n] : 0.0;
    }
  });
}

/// Energy removed, J (per radian or per metre).
double blend(Body& body, const std::array<std::vector<double>, 2>& seen, double flip) {
  Particles& p = body.particles;
  double removed = 0.0;
  for (std::size_t i = 0; i < body.on_grid(); ++i)
    for (std::size_t c = 0; c < 2; ++c) {
      const double before = p.velocity[c][i], after = seen[c][i] + flip * (before - seen[c][i]);
      removed += 0.5 * p.mass[i] * (before - after) * (before + after);
      p.velocity[c][i] = after;
    }
  return removed;
}

}  // namespace

bool filter_velocities(System& system) {
  if (system.flip == 1.0) return false;
  find_centroids(system);
  scatter(system, Scatter::momentum);
  project_freely(system);
  std::vector<std::array<std::vector<double>, 2>> seen(system.bodies.size());
  std::vector<std::array<std::vector<double>, 5>> unused(system.bodies.size());
  std::vector<ParticleGradient> targets(system.bodies.size());
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    const std::size_t size = system.bodies[n].particles.size;
    for (std::size_t c = 0; c < 2; ++c) {
      seen[n][c].resize(size);
      targets[n].value[c] = seen[n][c].data();
    }
    for (std::size_t k = 0; k < 5; ++k) {
      unused[n][k].resize(size);
      targets[n].gradient[k] = unused[n][k].data();
    }
  }
  gather_gradient(system, targets);
  double removed = 0.0;
  for (std::size_t n = 0; n < system.bodies.size(); ++n)
    removed += blend(system.bodies[n], seen[n], system.flip);
  system.record.filtered += removed;
  system.record.kinetic -= removed;
  return true;
}

}  // namespace vitrum::mpm
