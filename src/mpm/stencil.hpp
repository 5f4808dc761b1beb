#pragma once
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

  /// position: m; half: half the particle's side in cells.
  Stencils(const Chunk& chunk, const Block& block, double per_cell, double half, const ColumnReader& r,
           const ColumnReader& z) {
    const std::int32_t column = block.column * block_side - 1, row = block.row * block_side - 1;
#pragma omp simd
    for (std::size_t k = 0; k < chunk.size(); ++k) {
      const auto wr = Shape::at(r[k] * per_cell, half), wz = Shape::at(z[k] * per_cell, half);
      entry_[k] = (wz.first - row) * tile_columns + (wr.first - column);
      for (std::size_t a = 0; a < count; ++a) {
        value_[0][a][k] = wr.value[a], value_[1][a][k] = wz.value[a];
        slope_[0][a][k] = wr.slope[a], slope_[1][a][k] = wz.slope[a];
      }
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
  std::int32_t entry_[Chunk::capacity];
  alignas(64) double value_[2][count][Chunk::capacity], slope_[2][count][Chunk::capacity];
};

}  // namespace vitrum::mpm
