#include <numeric>

#include "mpm/axis.hpp"
#include "mpm/gather_columns.hpp"
#include "mpm/nodes.hpp"
#include "mpm/stencil.hpp"
#include "mpm/stress_update.hpp"
#include "mpm/transfer.hpp"

namespace vitrum::mpm {
namespace {

/// Adds the momenta of a chunk to the nodes of its tile.
template <class Stencils>
void add_momenta(const Chunk& chunk, const Particles& p, const Stencils& at, Pack<2>* nodes) {
  const ColumnReader mass(chunk, p.mass), v0(chunk, p.velocity[0]), v1(chunk, p.velocity[1]);
  for (std::size_t k = 0; k < chunk.size(); ++k) {
    const Pack<2> momentum{mass[k] * v0[k], mass[k] * v1[k]};
    for (std::size_t b = 0; b < at.count; ++b)
      for (std::size_t a = 0; a < at.count; ++a)
        nodes[at.entry(k) + b * tile_columns + a] += at.value(0, a, k) * at.value(1, b, k) * momentum;
  }
}

/// Returns the kinetic energy of the tile's particles, for plans that change velocities.
/// P: a plan. targets: by body, for the plans that have a target; otherwise null. stress: null where it is
/// not updated.
template <ShapeKind kind, bool axisymmetric, class P, class Target>
double gather_tile(System& system, std::size_t tile, double duration, [[maybe_unused]] const Target* targets,
                   [[maybe_unused]] StressUpdate* stress) {
  Grid& grid = system.grid;
  const Block& block = grid.blocks()[static_cast<std::size_t>(grid.tiles()[tile])];
  const NodePacks<kind, P> nodes(grid, tile);
  Pack<2>* momenta = grid.tile_data(tile).template packs<2>();
  if constexpr (P::rescatter) clear_tile<kind>(momenta);

  if constexpr (P::strain)
    if (stress != nullptr) stress->start(tile);

  double kinetic = 0.0;
  [[maybe_unused]] bool left = false;
  const double cell = grid.cell(), per_cell = 1.0 / cell;
  [[maybe_unused]] const CellRange cells(block, per_cell);
  Interpolated<P> at;
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    Body& body = system.bodies[n];
    Particles& p = body.particles;
    for_chunks(grid, tile, n, [&](const Chunk& chunk) {
      const ColumnReader r(chunk, p.position[0]), z(chunk, p.position[1]);
      const Stencils<kind> stencils(chunk, block, per_cell, body, r, z);
      at.gather(stencils, chunk.size(), nodes);
      if constexpr (P::gradient)
        if (!p.centroids[0].empty()) at.take_between_centroids(chunk, p);
      if constexpr (P::gradient && !P::strain) store_gradient<axisymmetric>(chunk, targets[n], at, r, cell);
      if constexpr (P::rates)
        for (std::size_t c = 0; c < 2; ++c) {
          ColumnWriter x(chunk, targets[n].position[c]), v(chunk, targets[n].velocity[c]);
          for (std::size_t k = 0; k < chunk.size(); ++k)
            x[k] = at.values()[P::width * k + c], v[k] = at.values()[P::width * k + 2 + c];
          if (!p.centroids[0].empty()) {  // as fixed to the interpolated centroids
            const ColumnReader across(chunk, p.from_centroids[1 - c]);
            const double sign = c == 0 ? -1.0 : 1.0;
            for (std::size_t k = 0; k < chunk.size(); ++k) x[k] += sign * at.spin(k, cell) * across[k];
          }
        }
      if constexpr (P::strain) {
        if (stress != nullptr)
          strain_and_stress<axisymmetric>(chunk, body, tile, n, *stress, at, r, cell, duration);
        else
          store_strain<axisymmetric>(chunk, p, at, r, cell, duration);
      }
      if constexpr (P::velocity) kinetic += store_velocity(chunk, p, at);
      if constexpr (P::rescatter) add_momenta(chunk, p, stencils, momenta);
      if constexpr (P::position)
        if (!p.centroids[0].empty()) at.turn_about_centroids(chunk, p, duration);
      if constexpr (P::position) left |= store_position<axisymmetric>(chunk, p, at, r, z, cells, duration);
    });
  }
  if constexpr (P::strain)
    if (stress != nullptr) stress->finish(tile);
  if constexpr (P::position) grid.note_moved(tile, system.bodies, left);
  if constexpr (P::rescatter && kind != ShapeKind::linear) fold_images(grid.images(tile), momenta);
  return kinetic;
}

/// Adds up what the tiles hold for the momenta of a block's nodes: their velocities.
template <ShapeKind kind>
void project_momenta(const Pass& pass, std::size_t block) {
  Grid& grid = pass.system->grid;
  Pack<2> sums[block_nodes]{};
  for_shares<kind>(grid, grid.blocks()[block],
                   [&](const TileData& tile, std::size_t entry, std::size_t node) {
                     sums[node] += tile.packs<2>()[entry];
                   });
  alignas(64) double p0[block_nodes], p1[block_nodes];
  for (int node = 0; node < block_nodes; ++node) p0[node] = sums[node][0], p1[node] = sums[node][1];
  project_block(grid, block, {p0, p1}, true);
}

void book_kinetic_energy(const Pass& pass) {
  const std::size_t tiles = pass.system->grid.tiles().size();
  pass.system->record.kinetic =
      std::accumulate(pass.parts->begin(), pass.parts->begin() + static_cast<std::ptrdiff_t>(tiles), 0.0);
}

template <class P, class Target>
Pass pass_of(System& system, double duration) {
  Pass pass;
  pass.system = &system, pass.duration = duration;
  dispatch(system.grid, [&]<ShapeKind kind, bool axisymmetric>() {
    pass.tile = [](const Pass& own, std::size_t tile) {
      const double kinetic = gather_tile<kind, axisymmetric, P>(
          *own.system, tile, own.duration, static_cast<const Target*>(own.targets), own.stress);
      if constexpr (P::velocity) (*own.parts)[tile] = kinetic;
    };
    if constexpr (P::rescatter) pass.block = project_momenta<kind>;
  });
  if constexpr (P::velocity) {
    static thread_local std::vector<double> kinetic_of_tile;  // of the calling thread; workers write to it
    kinetic_of_tile.resize(system.grid.tiles().size());
    pass.parts = &kinetic_of_tile;
    pass.finish = book_kinetic_energy;
  }
  return pass;
}

template <class P, class Target>
void gather_to(System& system, std::span<const Target> targets) {
  Pass pass = pass_of<P, Target>(system, 1.0);
  pass.targets = targets.data();
  sweep(system, {{pass}});
}

}  // namespace

Pass gather_pass(System& system, Gather what, double duration, StressUpdate* stress) {
  const auto pass = [&]<Gather w>() {
    Pass made = pass_of<Plan<w>, void>(system, duration);
    made.stress = stress;
    if (Plan<w>::strain && stress == nullptr)
      for (Body& body : system.bodies) body.particles.keep_increments();
    return made;
  };
  switch (what) {
    case Gather::strain:
      return pass.template operator()<Gather::strain>();
    case Gather::velocity:
      return pass.template operator()<Gather::velocity>();
    case Gather::position:
      return pass.template operator()<Gather::position>();
    case Gather::velocity_and_position:
      return pass.template operator()<Gather::velocity_and_position>();
    case Gather::all_from_new:
      return pass.template operator()<Gather::all_from_new>();
    case Gather::velocity_and_rescatter:
      return pass.template operator()<Gather::velocity_and_rescatter>();
    case Gather::strain_and_position:
      return pass.template operator()<Gather::strain_and_position>();
  }
  return {};
}

void gather(System& system, Gather what, double duration) {
  sweep(system, {{gather_pass(system, what, duration)}});
}

void gather_rates(System& system, std::span<const ParticleRates> rates) {
  gather_to<RatesPlan>(system, rates);
}

void gather_gradient(System& system, std::span<const ParticleGradient> gradients) {
  gather_to<GradientPlan>(system, gradients);
}

double kinetic_energy(const System& system) {
  double sum = 0.0;
  for (const Body& body : system.bodies)
    for (std::size_t i = 0; i < body.particles.size; ++i) {
      const double v0 = body.particles.velocity[0][i], v1 = body.particles.velocity[1][i];
      sum += 0.5 * body.particles.mass[i] * (v0 * v0 + v1 * v1);
    }
  return sum;
}

}  // namespace vitrum::mpm
