#pragma once
#include <algorithm>
#include <span>

#include "mpm/system.hpp"

/// A tile is the patch of nodes around one block, contiguous in memory: particles of the block read and write
/// it without looking up nodes. Node (i, j) of the block is tile entry (j + 1) tile_columns + i + 1.
namespace vitrum::mpm {

/// The columns (or rows) of nodes that particles of a block's cells can touch before its first and after its
/// last.
template <ShapeKind kind>
struct Reach {
  static constexpr int before = kind == ShapeKind::linear ? 0 : 1, after = kind == ShapeKind::linear ? 1 : 2;
};

/// Where a block at offset d (-1, 0, 1) from another one overlaps what of the other's tile can be touched:
/// `count` nodes from `node` in the block, from `entry` in the tile. Compile-time, so that rows are copied
/// without a call.
template <ShapeKind kind, int d>
struct Overlap {
  static constexpr int node = d < 0 ? block_side - 1 : 0;
  static constexpr int entry = d < 0 ? 0 : d == 0 ? 1 : block_side + 1;
  static constexpr int count = d < 0 ? Reach<kind>::before : d == 0 ? block_side : Reach<kind>::after;
};

/// Clears what of a tile can be touched.
template <ShapeKind kind, class Value>
inline void clear_tile(Value* tile) {
  constexpr int first = 1 - Reach<kind>::before, last = 1 + block_side + Reach<kind>::after;
  std::fill(tile + first * tile_columns, tile + last * tile_columns, Value{});
}

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

/// The node at column i, row j of a block's own count (-2 .. 9); -1: in no block.
inline std::int64_t node_at(const Block& block, int i, int j) {
  const auto side = [](int k) { return k < 0 ? -1 : k >= block_side ? 1 : 0; };
  const std::int32_t n = neighbour(block, side(i), side(j));
  if (n < 0) return -1;
  return std::int64_t{n} * block_nodes + ((j + block_side) % block_side) * block_side +
         (i + block_side) % block_side;
}
/// The entry of that node in the block's tile.
inline std::uint8_t tile_entry(int i, int j) {
  return static_cast<std::uint8_t>((j + 1) * tile_columns + i + 1);
}

/// Fills what of the tile of block `b` can be touched: by load(node, value), or with zero where there is no
/// node.
template <ShapeKind kind, class Value, class Load>
inline void load_tile(const Block& b, Load&& load, Value* tile) {
  for_neighbourhood([&]<int di, int dj>() {
    using I = Overlap<kind, di>;
    using J = Overlap<kind, dj>;
    if constexpr (I::count != 0 && J::count != 0) {
      const std::int32_t n = neighbour(b, di, dj);
      const std::size_t node =
          static_cast<std::size_t>(n < 0 ? 0 : n) * block_nodes + J::node * block_side + I::node;
      for (std::size_t row = 0; row < J::count; ++row) {
        Value* to = tile + (J::entry + row) * tile_columns + I::entry;
        for (std::size_t column = 0; column < I::count; ++column)
          if (n < 0)
            to[column] = Value{};
          else
            load(node + row * block_side + column, to[column]);
      }
    }
  });
}

/// Calls add(tile, entry, node) for every node (0 .. block_nodes - 1) of block `b` and every tile whose
/// particles can touch it, in a fixed order.
template <ShapeKind kind, class Add>
inline void for_shares(Grid& grid, const Block& b, Add&& add) {
  for_neighbourhood([&]<int di, int dj>() {
    using I = Overlap<kind, -di>;  // seen from the neighbour, this block lies at (-di, -dj)
    using J = Overlap<kind, -dj>;
    if constexpr (I::count != 0 && J::count != 0) {
      const std::int32_t n = neighbour(b, di, dj);
      if (n < 0 || grid.blocks()[static_cast<std::size_t>(n)].tile < 0) return;
      const TileData& tile =
          grid.tile_data(static_cast<std::size_t>(grid.blocks()[static_cast<std::size_t>(n)].tile));
      for (std::size_t row = 0; row < J::count; ++row)
        for (std::size_t column = 0; column < I::count; ++column)
          add(tile, (J::entry + row) * tile_columns + I::entry + column,
              (J::node + row) * block_side + I::node + column);
    }
  });
}

/// The sign that a place in a node's vectors, side by side, changes with under reflection at a plane across a
/// component.
inline double parity(std::size_t place, std::uint8_t component) {
  return place % 2 == component ? -1.0 : 1.0;
}

/// A plane of symmetry (the axis, or a boundary that mirrors): the image of a particle touches a node as the
/// particle touches the node's image. Folds what images have collected onto their nodes; note(n, from) sees
/// what the n-th of them had.
template <class Vectors, class Note>
inline void fold_images(std::span<const Image> images, Vectors* tile, Note&& note) {
  for (std::size_t n = 0; n < images.size(); ++n) {
    const Image& image = images[n];
    Vectors &node = tile[image.node], &from = tile[image.entry];
    note(n, from);
    for (std::size_t k = 0; k < sizeof(Vectors) / sizeof(double); ++k)
      node[k] += parity(k, image.component) * from[k];
    from = Vectors{};
  }
}
template <class Vectors>
inline void fold_images(std::span<const Image> images, Vectors* tile) {
  fold_images(images, tile, [](std::size_t, const Vectors&) {});
}
template <class Note>
inline void fold_images(std::span<const Image> images, double* masses, Note&& note) {
  for (std::size_t n = 0; n < images.size(); ++n) {
    const Image& image = images[n];
    note(n, masses[image.entry]);
    masses[image.node] += masses[image.entry], masses[image.entry] = 0.0;
  }
}
/// Fills the images of a tile that is to be read from.
template <class Vectors>
inline void fill_images(std::span<const Image> images, Vectors* tile) {
  for (std::size_t n = images.size(); n-- > 0;)
    for (std::size_t k = 0; k < sizeof(Vectors) / sizeof(double); ++k)
      tile[images[n].entry][k] = parity(k, images[n].component) * tile[images[n].node][k];
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
      case ShapeKind::cpgimp:
        return f.template operator()<ShapeKind::cpgimp, axisymmetric>();
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
