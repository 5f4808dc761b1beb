#include "mpm/tile.hpp"
#include "mpm/transfer.hpp"

namespace vitrum::mpm {
namespace {

// Slots of a tile.
constexpr std::size_t mass_slot = 0, momentum_slot = 1, force_slot = 3;

template <ShapeKind kind, bool axisymmetric, bool with_momentum, bool with_force>
void scatter_tile(System& system, std::size_t tile) {
  using S = Shape1<kind>;
  Grid& grid = system.grid;
  const Block& block = grid.blocks()[static_cast<std::size_t>(grid.tiles()[tile])];
  double* data = grid.tile_data(tile);
  double *mass = data + mass_slot * tile_nodes, *p0 = data + momentum_slot * tile_nodes,
         *p1 = p0 + tile_nodes;
  double *f0 = data + force_slot * tile_nodes, *f1 = f0 + tile_nodes;
  if constexpr (with_momentum) std::fill(mass, mass + 3 * tile_nodes, 0.0);
  if constexpr (with_force) std::fill(f0, f0 + 2 * tile_nodes, 0.0);

  const double per_cell = 1.0 / grid.cell();
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    const auto [begin, end] = grid.particles(tile, n);
    if (begin == end) continue;
    const Body& body = system.bodies[n];
    const Particles& p = body.particles;
    const double half = body.particle_half_size * per_cell;
    const double* stress_zr = p.stress_zr.empty() ? p.stress[3].data() : p.stress_zr.data();
    const double specific_volume = 1.0 / body.material->parameters().elastic.density;
    for (const std::uint32_t* k = begin; k != end; ++k) {
      const std::size_t i = *k;
      const double r = p.position[0][i];
      const auto wr = S::at(r * per_cell, half), wz = S::at(p.position[1][i] * per_cell, half);
      const std::size_t entry = tile_entry(block, wr, wz);
      const double m = p.mass[i], mv0 = m * p.velocity[0][i], mv1 = m * p.velocity[1][i];
      double rr = 0.0, zz = 0.0, rz = 0.0, zr = 0.0, hoop = 0.0;
      if constexpr (with_force) {
        const double volume = m * specific_volume;
        rr = -volume * p.stress[0][i] * per_cell, zz = -volume * p.stress[1][i] * per_cell;
        rz = -volume * p.stress[3][i] * per_cell, zr = -volume * stress_zr[i] * per_cell;
        if constexpr (axisymmetric) hoop = -volume * p.stress[2][i] / hoop_radius(r, grid.cell());
      }
      for (std::size_t b = 0; b < S::count; ++b)
        for (std::size_t a = 0; a < S::count; ++a) {
          const std::size_t node = entry + b * tile_columns + a;
          const double N = wr.value[a] * wz.value[b];
          if constexpr (with_momentum) {
            mass[node] += N * m;
            p0[node] += N * mv0;
            p1[node] += N * mv1;
          }
          if constexpr (with_force) {
            const double Nr = wr.slope[a] * wz.value[b], Nz = wr.value[a] * wz.slope[b];
            f0[node] += rr * Nr + rz * Nz + hoop * N;
            f1[node] += zr * Nr + zz * Nz;
          }
        }
    }
  }
  if constexpr (axisymmetric && kind != ShapeKind::linear) {
    if (block.column == 0) {
      if constexpr (with_momentum) fold_axis(mass, 1.0), fold_axis(p0, -1.0), fold_axis(p1, 1.0);
      if constexpr (with_force) fold_axis(f0, -1.0), fold_axis(f1, 1.0);
    }
  }
}

template <bool with_momentum, bool with_force>
void scatter_all(System& system) {
  Grid& grid = system.grid;
  dispatch(grid, [&]<ShapeKind kind, bool axisymmetric>() {
    system.team->for_each_chunk(grid.tiles().size(), [&](std::size_t tile) {
      scatter_tile<kind, axisymmetric, with_momentum, with_force>(system, tile);
    });
  });
  system.team->for_each_chunk(grid.blocks().size(), [&](std::size_t n) {
    const Block& b = grid.blocks()[n];
    if constexpr (with_momentum) {
      reduce_tiles(grid, b, n, mass_slot, Field::mass);
      reduce_tiles(grid, b, n, momentum_slot, Field::momentum_0);
      reduce_tiles(grid, b, n, momentum_slot + 1, Field::momentum_1);
    }
    if constexpr (with_force) {
      reduce_tiles(grid, b, n, force_slot, Field::force_0);
      reduce_tiles(grid, b, n, force_slot + 1, Field::force_1);
    }
  });
}

}  // namespace

void refresh_grid(System& system) {
  if (!system.grid_is_stale) return;
  system.grid.rebuild(system.bodies);
  system.grid_is_stale = false;
}

void refresh_grid_for_positions(System& system) {
  if (!system.grid_is_stale) {
    Grid& grid = system.grid;
    static thread_local std::vector<char> of_tile;  // of the calling thread; workers write to its elements
    std::vector<char>& left = of_tile;
    left.assign(grid.tiles().size(), 0);
    system.team->for_each_chunk(grid.tiles().size(), [&](std::size_t tile) {
      left[tile] = grid.has_left(tile, system.bodies) ? 1 : 0;
    });
    for (const char l : left) system.grid_is_stale |= l != 0;
  }
  refresh_grid(system);
}

void scatter(System& system, Scatter what) {
  switch (what) {
    case Scatter::momentum:
      return scatter_all<true, false>(system);
    case Scatter::force:
      return scatter_all<false, true>(system);
    case Scatter::momentum_and_force:
      return scatter_all<true, true>(system);
  }
}

}  // namespace vitrum::mpm
