#include <array>
#include <numeric>

#include "mpm/contributions.hpp"
#include "mpm/loads.hpp"
#include "mpm/nodes.hpp"
#include "mpm/transfer.hpp"

namespace vitrum::mpm {
namespace {

template <Scatter what>
struct Plan {
  static constexpr bool momentum = what != Scatter::force, force = what != Scatter::momentum;
  static constexpr int width = momentum && force ? 4 : 2;
};

template <ShapeKind kind, bool axisymmetric, class P>
void scatter_tile(System& system, std::size_t tile) {
  Grid& grid = system.grid;
  const Block& block = grid.blocks()[static_cast<std::size_t>(grid.tiles()[tile])];
  TileData& data = grid.tile_data(tile);
  Pack<P::width>* vectors = data.template packs<P::width>();
  double* masses = data.mass;
  clear_tile<kind>(vectors);
  if constexpr (P::momentum) clear_tile<kind>(masses);

  const double per_cell = 1.0 / grid.cell();
  Contributions<axisymmetric, P> gives;
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    const Body& body = system.bodies[n];
    for_chunks(grid, tile, n, [&](const Chunk& chunk) {
      const ColumnReader r(chunk, body.particles.position[0]), z(chunk, body.particles.position[1]);
      const Stencils<kind> at(chunk, block, per_cell, body, r, z);
      gives.gather(chunk, body, grid.cell(), r);
      for (std::size_t k = 0; k < chunk.size(); ++k) {
        const Contribution<P::width>& c = gives[k];
        for (std::size_t b = 0; b < at.count; ++b)
          for (std::size_t a = 0; a < at.count; ++a) {
            const std::size_t node = at.entry(k) + b * tile_columns + a;
            const double N = at.value(0, a, k) * at.value(1, b, k);
            Pack<P::width> sum = vectors[node] + N * c.share;
            if constexpr (P::force) {
              sum += at.slope(0, a, k) * at.value(1, b, k) * c.r;
              sum += at.value(0, a, k) * at.slope(1, b, k) * c.z;
            }
            vectors[node] = sum;
            if constexpr (P::momentum) masses[node] += N * gives.mass(k);
          }
      }
    });
  }
  if constexpr (kind != ShapeKind::linear) {
    const std::span<const Image> images = grid.images(tile);
    const std::span<ImageSums> sums = grid.image_sums(tile);
    fold_images(images, vectors, [&](std::size_t n, const Pack<P::width>& from) {
      if constexpr (P::force)
        if (!sums.empty()) sums[n].force = from[P::width - 2 + images[n].component];
    });
    if constexpr (P::momentum)
      fold_images(images, masses, [&](std::size_t n, double from) {
        if (!sums.empty()) sums[n].mass = from;
      });
  }
}

/// Adds up what the tiles hold for the nodes of a block: their masses, and their vectors by component.
template <ShapeKind kind, class P>
void sum_block(Grid& grid, std::size_t index, const std::array<double*, P::width>& to) {
  Pack<P::width> vectors[block_nodes]{};
  double mass[block_nodes]{};
  for_shares<kind>(grid, grid.blocks()[index],
                   [&](const TileData& tile, std::size_t entry, std::size_t node) {
                     vectors[node] += tile.template packs<P::width>()[entry];
                     if constexpr (P::momentum) mass[node] += tile.mass[entry];
                   });
  if constexpr (P::momentum)
    std::copy(mass, mass + block_nodes, grid.field(Field::mass) + index * block_nodes);
  for (std::size_t c = 0; c < P::width; ++c)
    for (int node = 0; node < block_nodes; ++node) to[c][node] = vectors[node][c];
}

/// The sums of a block, to be kept.
template <ShapeKind kind, class P>
void store_sums(const Pass& pass, std::size_t block) {
  constexpr auto first = static_cast<std::size_t>(P::momentum ? Field::momentum_0 : Field::force_0);
  std::array<double*, P::width> to{};
  for (std::size_t c = 0; c < P::width; ++c)
    to[c] = pass.system->grid.field(static_cast<Field>(first + c)) + block * block_nodes;
  sum_block<kind, P>(pass.system->grid, block, to);
}

/// The sums of a block are made velocities at once, and new velocities if it has forces.
template <ShapeKind kind, class P>
void move_block(const Pass& pass, std::size_t block) {
  System& system = *pass.system;
  Grid& grid = system.grid;
  alignas(64) double sums[P::width][block_nodes];
  std::array<double*, P::width> to{};
  for (std::size_t c = 0; c < P::width; ++c) to[c] = sums[c];
  sum_block<kind, P>(grid, block, to);
  if constexpr (P::momentum) {
    project_block(grid, block, {sums[0], sums[1]});
    if (grid.keeps_sums() && grid.blocks()[block].constrained)
      for (std::size_t c = 0; c < 2; ++c)
        std::copy_n(sums[c], block_nodes,
                    grid.field(c == 0 ? Field::momentum_0 : Field::momentum_1) + block * block_nodes);
  }
  if constexpr (P::force) {
    const BlockVector force{sums[P::width - 2], sums[P::width - 1]};
    accelerate_block(grid, block, force, system.gravity, pass.duration);
    if (grid.keeps_forces(block))
      for (std::size_t c = 0; c < 2; ++c)
        std::copy_n(force[c], block_nodes,
                    grid.field(c == 0 ? Field::force_0 : Field::force_1) + block * block_nodes);
    if (pass.parts != nullptr)
      (*pass.parts)[block] = external_power(system, block, force, Field::velocity_0, Field::new_velocity_0);
  }
}

void book_external_work(const Pass& pass) {
  const std::size_t blocks = pass.system->grid.blocks().size();
  pass.system->record.external_work +=
      pass.duration *
      std::accumulate(pass.parts->begin(), pass.parts->begin() + static_cast<std::ptrdiff_t>(blocks), 0.0);
}

template <Scatter what>
Pass pass_of(System& system, Nodes until) {
  using P = Plan<what>;
  Pass pass;
  dispatch(system.grid, [&]<ShapeKind kind, bool axisymmetric>() {
    pass.tile = [](const Pass& own, std::size_t tile) {
      scatter_tile<kind, axisymmetric, P>(*own.system, tile);
    };
    pass.block = until == Nodes::sums ? store_sums<kind, P> : move_block<kind, P>;
  });
  // What a boundary that changes speed does depends on the momenta that it meets (external_power).
  if (until == Nodes::sums || drives(system)) system.grid.keep_sums();
  return pass;
}

}  // namespace

Pass scatter_pass(System& system, Scatter what, Nodes until, double duration) {
  Pass pass;
  switch (what) {
    case Scatter::momentum:
      pass = pass_of<Scatter::momentum>(system, until);
      break;
    case Scatter::force:
      pass = pass_of<Scatter::force>(system, until);
      break;
    case Scatter::momentum_and_force:
      pass = pass_of<Scatter::momentum_and_force>(system, until);
      break;
  }
  pass.system = &system, pass.duration = duration;
  if (until == Nodes::moved && what != Scatter::momentum && has_external_work(system)) {
    static thread_local std::vector<double> power_of_block;  // of the calling thread; workers write to it
    power_of_block.resize(system.grid.blocks().size());
    pass.parts = &power_of_block;
    pass.finish = book_external_work;
  }
  return pass;
}

void scatter(System& system, Scatter what, Nodes until, double duration) {
  sweep(system, {{scatter_pass(system, what, until, duration)}});
}

}  // namespace vitrum::mpm
