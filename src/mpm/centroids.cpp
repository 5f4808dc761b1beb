#include "mpm/centroids.hpp"

#include <limits>

#include "mpm/pass.hpp"
#include "mpm/stencil.hpp"

namespace vitrum::mpm {
namespace {

/// Adds to every node of a tile what a particle weighs there, and that times the way from the node to it,
/// cells. The weight is the mass, so that rigid motion is exact; with an axis the mass per radius, so that in
/// the interior centroids are where nodes are, however near the axis is.
template <ShapeKind kind, bool axisymmetric>
void collect_tile(const Pass& pass, std::size_t tile) {
  System& system = *pass.system;
  Grid& grid = system.grid;
  const Block& block = grid.blocks()[static_cast<std::size_t>(grid.tiles()[tile])];
  TileData& data = grid.tile_data(tile);
  Pack<2>* ways = data.packs<2>();
  clear_tile<kind>(ways);
  clear_tile<kind>(data.mass);
  const double per_cell = 1.0 / grid.cell();
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    const Body& body = system.bodies[n];
    for_chunks(grid, tile, n, [&](const Chunk& chunk) {
      const ColumnReader r(chunk, body.particles.position[0]), z(chunk, body.particles.position[1]),
          mass(chunk, body.particles.mass);
      const Stencils<kind> at(chunk, block, per_cell, body, r, z);
      for (std::size_t k = 0; k < chunk.size(); ++k) {
        const double weight = axisymmetric ? mass[k] / hoop_radius(r[k], grid.cell()) : mass[k];
        const auto entry = static_cast<std::int32_t>(at.entry(k));
        const double from_r = r[k] * per_cell - (block.column * block_side + entry % tile_columns - 1),
                     from_z = z[k] * per_cell - (block.row * block_side + entry / tile_columns - 1);
        for (std::size_t b = 0; b < at.count; ++b)
          for (std::size_t a = 0; a < at.count; ++a) {
            const std::size_t node = at.entry(k) + b * tile_columns + a;
            const double share = at.value(0, a, k) * at.value(1, b, k) * weight;
            ways[node] += share * Pack<2>{from_r - static_cast<double>(a), from_z - static_cast<double>(b)};
            data.mass[node] += share;
          }
      }
    });
  }
  if constexpr (kind != ShapeKind::linear) {
    fold_images(grid.images(tile), ways);
    fold_images(grid.images(tile), data.mass);
  }
}

/// Centroids of a block's nodes, cells from the node. Where a component is held, the node's velocity is that
/// of its own place.
template <ShapeKind kind>
void find_centroids_of_block(const Pass& pass, std::size_t block) {
  Grid& grid = pass.system->grid;
  Pack<2> ways[block_nodes]{};
  double weights[block_nodes]{};
  for_shares<kind>(grid, grid.blocks()[block],
                   [&](const TileData& tile, std::size_t entry, std::size_t node) {
                     ways[node] += tile.packs<2>()[entry];
                     weights[node] += tile.mass[entry];
                   });
  const bool constrained = grid.blocks()[block].constrained;
  for (std::size_t c = 0; c < 2; ++c) {
    double* to = grid.field(c == 0 ? Field::centroid_0 : Field::centroid_1) + block * block_nodes;
    for (std::size_t n = 0; n < block_nodes; ++n) {
      const bool filled = weights[n] > std::numeric_limits<double>::min(),
                 held = constrained && grid.constraint(c, block * block_nodes + n) != Constraint::free;
      to[n] = filled && !held ? ways[n][c] / weights[n] : 0.0;
    }
  }
}

/// Gradient of the centroids at the particles of a tile.
template <ShapeKind kind>
void spread_tile(const Pass& pass, std::size_t tile) {
  System& system = *pass.system;
  const Grid& grid = system.grid;
  const Block& block = grid.blocks()[static_cast<std::size_t>(grid.tiles()[tile])];
  const double *c0 = grid.field(Field::centroid_0), *c1 = grid.field(Field::centroid_1);
  Pack<2> nodes[tile_nodes];
  load_tile<kind>(
      block,
      [&](std::size_t n, Pack<2>& node) {
        node = Pack<2>{c0[n], c1[n]};
      },
      nodes);
  if constexpr (kind != ShapeKind::linear) fill_images(grid.images(tile), nodes);
  const double per_cell = 1.0 / grid.cell();
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    Body& body = system.bodies[n];
    for_chunks(grid, tile, n, [&](const Chunk& chunk) {
      const ColumnReader r(chunk, body.particles.position[0]), z(chunk, body.particles.position[1]);
      const Stencils<kind> at(chunk, block, per_cell, body, r, z);
      auto& to = body.particles.centroids;
      ColumnWriter rr(chunk, to[0]), rz(chunk, to[1]), zr(chunk, to[2]), zz(chunk, to[3]),
          from_r(chunk, body.particles.from_centroids[0]), from_z(chunk, body.particles.from_centroids[1]);
      for (std::size_t k = 0; k < chunk.size(); ++k) {
        Pack<2> way{}, along_r{1.0, 0.0}, along_z{0.0, 1.0};  // of the nodes' own places
        for (std::size_t b = 0; b < at.count; ++b)
          for (std::size_t a = 0; a < at.count; ++a) {
            const Pack<2>& node = nodes[at.entry(k) + b * tile_columns + a];
            way += at.value(0, a, k) * at.value(1, b, k) * node;
            along_r += at.slope(0, a, k) * at.value(1, b, k) * node;
            along_z += at.value(0, a, k) * at.slope(1, b, k) * node;
          }
        from_r[k] = -grid.cell() * way[0], from_z[k] = -grid.cell() * way[1];
        rr[k] = along_r[0], rz[k] = along_z[0], zr[k] = along_r[1], zz[k] = along_z[1];
      }
    });
  }
}

}  // namespace

void find_centroids(System& system) {
  if (!system.between_centroids) return;
  system.grid.keep_centroids();
  for (Body& body : system.bodies) {
    Particles& p = body.particles;
    for (auto& column : p.centroids) column.resize(p.size);
    for (auto& column : p.from_centroids) column.resize(p.size);
    p.spin_increment.resize(p.size);
  }
  Pass collect, spread;
  collect.system = spread.system = &system;
  dispatch(system.grid, [&]<ShapeKind kind, bool axisymmetric>() {
    collect.tile = collect_tile<kind, axisymmetric>;
    collect.block = find_centroids_of_block<kind>;
    spread.tile = spread_tile<kind>;
  });
  sweep(system, {{collect, spread}});
}

}  // namespace vitrum::mpm
