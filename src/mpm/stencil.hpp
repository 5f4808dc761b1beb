#pragma once
#include <utility>

#include "mpm/chunk.hpp"
#include "mpm/tile.hpp"

namespace vitrum::mpm {

/// Where the particles of a chunk stand in their tile, and their shape functions there. Computed for all of
/// them before any node is touched, so that the compiler computes several at a time.
template <ShapeKind kind>
class Stencils {
 public:
  using Shape = Shape1<kind>;
  static constexpr std::size_t count = static_cast<std::size_t>(Shape::count);

  /// r, z: positions of the chunk's particles, m.
  Stencils(const Chunk& chunk, const Block& block, double per_cell, const Body& body, const ColumnReader& r,
           const ColumnReader& z) {
    const std::int32_t column = block.column * block_side - 1, row = block.row * block_side - 1;
    const double *x = r.data(), *y = z.data();
    const std::size_t size = chunk.size();
    if constexpr (kind == ShapeKind::cpgimp) {
      const ColumnReader half_r(chunk, body.particles.domain[0]), half_z(chunk, body.particles.domain[1]);
      const double *hr = half_r.data(), *hz = half_z.data();
      // The last node of the tile is the last that a particle of the block can touch.
      const std::int32_t last_column = column + block_side - 1, last_row = row + block_side - 1;
#pragma GCC ivdep
      for (std::size_t k = 0; k < size; ++k)
        put(k, column, row, Shape::at(x[k] * per_cell, hr[k] * per_cell, last_column),
            Shape::at(y[k] * per_cell, hz[k] * per_cell, last_row));
    } else {
      const double half = body.particle_half_size * per_cell;
#pragma GCC ivdep
      for (std::size_t k = 0; k < size; ++k)
        put(k, column, row, Shape::at(x[k] * per_cell, half), Shape::at(y[k] * per_cell, half));
    }
  }

  /// Tile entry of the first node of particle k.
  std::size_t entry(std::size_t k) const {
    return static_cast<std::size_t>(entry_[k]);
  }
  /// N along r (axis 0) or z (axis 1) at the a-th node of particle k.
  double value(std::size_t axis, std::size_t a, std::size_t k) const {
    return value_[axis][a][k];
  }
  /// h dN/dx.
  double slope(std::size_t axis, std::size_t a, std::size_t k) const {
    if constexpr (kind == ShapeKind::linear) return a == 0 ? -1.0 : 1.0;  // known when compiling: no product
    return slope_[axis][a][k];
  }

 private:
  VITRUM_INLINE void put(std::size_t k, std::int32_t column, std::int32_t row,
                         const Weights1<Shape::count>& wr, const Weights1<Shape::count>& wz) {
    entry_[k] = (wz.first - row) * tile_columns + (wr.first - column);
    store(wr, 0, k, std::make_index_sequence<count>{});
    store(wz, 1, k, std::make_index_sequence<count>{});
  }
  /// A loop inside a loop would not be vectorised.
  template <std::size_t... a>
  void store(const Weights1<Shape::count>& w, std::size_t axis, std::size_t k, std::index_sequence<a...>) {
    ((value_[axis][a][k] = w.value[a], slope_[axis][a][k] = w.slope[a]), ...);
  }

  std::int32_t entry_[Chunk::capacity];
  alignas(64) double value_[2][count][Chunk::capacity], slope_[2][count][Chunk::capacity];
};

}  // namespace vitrum::mpm
