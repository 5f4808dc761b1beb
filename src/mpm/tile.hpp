#pragma once
#include <algorithm>

#include "mpm/system.hpp"

/// A tile is the patch of nodes around one block, contiguous in memory: particles of the block read and write
/// it without looking up nodes. Node (i, j) of the block is tile entry (j + 1) tile_columns + i + 1.
namespace vitrum::mpm {

/// Where a block at offset d (-1, 0, 1) from another one overlaps the other's tile: `count` nodes from `node`
/// in the block, from `entry` in the tile. Compile-time, so that rows are copied without a call.
template <int d>
struct Overlap {
  static constexpr int node = d < 0 ? block_side - 1 : 0;
  static constexpr int entry = d < 0 ? 0 : d == 0 ? 1 : block_side + 1;
  static constexpr int count = d < 0 ? 1 : d == 0 ? block_side : 2;
};

/// Calls f.operator()<di, dj>() for the 3 x 3 neighbourhood, in a fixed order.
template <class F>
inline void for_neighbourhood(F&& f) {
  f.template operator()<-1, -1>(), f.template operator()<0, -1>(), f.template operator()<1, -1>();
  f.template operator()<-1, 0>(), f.template operator()<0, 0>(), f.template operator()<1, 0>();
  f.template operator()<-1, 1>(), f.template operator()<0, 1>(), f.template operator()<1, 1>();
}

inline std::int32_t neighbour(const Block& b, int di, int dj) {
  return b.neighbours[static_cast<std::size_t>(3 * (dj + 1) + di + 1)];
}

/// Copies a nodal field into the tile of block `b` (absent blocks: zero).
inline void load_tile(const Block& b, const double* field, double* tile) {
  for_neighbourhood([&]<int di, int dj>() {
    using I = Overlap<di>;
    using J = Overlap<dj>;
    const std::int32_t n = neighbour(b, di, dj);
    double* to = tile + J::entry * tile_columns + I::entry;
    if (n < 0) {
      for (int row = 0; row < J::count; ++row)
        for (int column = 0; column < I::count; ++column) to[row * tile_columns + column] = 0.0;
      return;
    }
    const double* from = field + static_cast<std::size_t>(n) * block_nodes + J::node * block_side + I::node;
    for (int row = 0; row < J::count; ++row)
      for (int column = 0; column < I::count; ++column)
        to[row * tile_columns + column] = from[row * block_side + column];
  });
}

/// Adds up what all tiles hold for the nodes of block `b`. slot: which of a tile's five fields.
inline void reduce_tiles(Grid& grid, const Block& b, std::size_t block, std::size_t slot, Field field) {
  double* nodes = grid.field(field) + block * block_nodes;
  std::fill(nodes, nodes + block_nodes, 0.0);
  for_neighbourhood([&]<int di, int dj>() {
    using I = Overlap<-di>;  // seen from the neighbour, this block lies at (-di, -dj)
    using J = Overlap<-dj>;
    const std::int32_t n = neighbour(b, di, dj);
    if (n < 0 || grid.blocks()[static_cast<std::size_t>(n)].tile < 0) return;
    const double* from =
        grid.tile_data(static_cast<std::size_t>(grid.blocks()[static_cast<std::size_t>(n)].tile)) +
        slot * tile_nodes + J::entry * tile_columns + I::entry;
    double* to = nodes + J::node * block_side + I::node;
    for (int row = 0; row < J::count; ++row)
      for (int column = 0; column < I::count; ++column)
        to[row * block_side + column] += from[row * tile_columns + column];
  });
}

/// The axis is a plane of symmetry: the image of a particle at -r touches node +1 as the particle touches
/// node -1, with the opposite radial component. Folds column -1 of a summed tile onto column +1. parity: +1
/// or -1.
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
inline double hoop_radius(double r, double cell) {
  return std::max(r, 1e-9 * cell);
}

/// Calls f(template arguments) for the shape functions and geometry of a grid.
template <class F>
void dispatch(const Grid& grid, F&& f) {
  const auto with_shape = [&]<bool axisymmetric>() {
    switch (grid.shape()) {
      case ShapeKind::linear:
        return f.template operator()<ShapeKind::linear, axisymmetric>();
      case ShapeKind::gimp:
        return f.template operator()<ShapeKind::gimp, axisymmetric>();
      case ShapeKind::bspline2:
        return f.template operator()<ShapeKind::bspline2, axisymmetric>();
    }
  };
  if (grid.axisymmetric())
    with_shape.template operator()<true>();
  else
    with_shape.template operator()<false>();
}

}  // namespace vitrum::mpm
