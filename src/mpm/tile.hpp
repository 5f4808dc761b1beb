#pragma once
#include <algorithm>

#include "mpm/system.hpp"

/// A tile is the patch of nodes around one block, contiguous in memory: particles of the block read and write it without
/// looking up nodes. Node (i, j) of the block is tile entry (j + 1) tile_columns + i + 1.
namespace vitrum::mpm {

/// Where a block at offset d (-1, 0, 1) from another one overlaps the other's tile: `count` nodes from `node` in the block, from
/// `entry` in the tile.
struct Overlap {
  int node, entry, count;
};
inline constexpr Overlap overlap_of_neighbour[3] = {{block_side - 1, 0, 1}, {0, 1, block_side}, {0, block_side + 1, 2}};

/// Copies a nodal field into the tile of block `b` (absent blocks: zero).
inline void load_tile(const Block& b, const double* field, double* tile) {
  for (int dj = -1; dj <= 1; ++dj)
    for (int di = -1; di <= 1; ++di) {
      const std::int32_t n = b.neighbours[static_cast<std::size_t>(3 * (dj + 1) + di + 1)];
      const Overlap i = overlap_of_neighbour[di + 1], j = overlap_of_neighbour[dj + 1];
      for (int row = 0; row < j.count; ++row) {
        double* to = tile + (j.entry + row) * tile_columns + i.entry;
        if (n < 0) {
          std::fill(to, to + i.count, 0.0);
        } else {
          const double* from = field + static_cast<std::size_t>(n) * block_nodes + (j.node + row) * block_side + i.node;
          std::copy(from, from + i.count, to);
        }
      }
    }
}

/// Adds up what all tiles hold for the nodes of block `b`. slot: which of a tile's five fields.
inline void reduce_tiles(Grid& grid, const Block& b, std::size_t block, std::size_t slot, Field field) {
  double* nodes = grid.field(field) + block * block_nodes;
  std::fill(nodes, nodes + block_nodes, 0.0);
  for (int dj = -1; dj <= 1; ++dj)
    for (int di = -1; di <= 1; ++di) {
      const std::int32_t n = b.neighbours[static_cast<std::size_t>(3 * (dj + 1) + di + 1)];
      if (n < 0 || grid.blocks()[static_cast<std::size_t>(n)].tile < 0) continue;
      const double* tile =
          grid.tile_data(static_cast<std::size_t>(grid.blocks()[static_cast<std::size_t>(n)].tile)) + slot * tile_nodes;
      // Seen from the neighbour, this block lies at (-di, -dj).
      const Overlap i = overlap_of_neighbour[1 - di], j = overlap_of_neighbour[1 - dj];
      for (int row = 0; row < j.count; ++row)
        for (int column = 0; column < i.count; ++column)
          nodes[(j.node + row) * block_side + i.node + column] +=
              tile[(j.entry + row) * tile_columns + i.entry + column];
    }
}

/// The axis is a plane of symmetry: the image of a particle at -r touches node +1 as the particle touches node -1, with the
/// opposite radial component. Folds column -1 of a summed tile onto column +1. parity: +1 or -1.
inline void fold_axis(double* tile, double parity) {
  for (int row = 0; row < tile_rows; ++row) {
    double* r = tile + row * tile_columns;
    r[2] += parity * r[0];
    r[0] = 0.0;
  }
}
/// Fills column -1 of a tile to be read from.
inline void mirror_axis(double* tile, double parity) {
  for (int row = 0; row < tile_rows; ++row) {
    double* r = tile + row * tile_columns;
    r[0] = parity * r[2];
  }
}

/// Tile entry of a particle's first node.
template <class W>
inline std::size_t tile_entry(const Block& b, const W& r, const W& z) {
  return static_cast<std::size_t>((z.first - std::int64_t{b.row} * block_side + 1) * tile_columns +
                                  (r.first - std::int64_t{b.column} * block_side + 1));
}

/// Radius used in the hoop terms: never 0 (there N v_r / r has its limit as r -> 0).
inline double hoop_radius(double r, double cell) { return std::max(r, 1e-9 * cell); }

/// Calls f(template arguments) for the shape functions and geometry of a grid.
template <class F>
void dispatch(const Grid& grid, F&& f) {
  const auto with_shape = [&]<bool axisymmetric>() {
    switch (grid.shape()) {
      case ShapeKind::linear: return f.template operator()<ShapeKind::linear, axisymmetric>();
      case ShapeKind::gimp: return f.template operator()<ShapeKind::gimp, axisymmetric>();
      case ShapeKind::bspline2: return f.template operator()<ShapeKind::bspline2, axisymmetric>();
    }
  };
  if (grid.axisymmetric())
    with_shape.template operator()<true>();
  else
    with_shape.template operator()<false>();
}

}  // namespace vitrum::mpm
