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

  /// position: m; half: half the particle's side in cells.
  Stencils(const Chunk& chunk, const Block& block, double per_cell, double half, const ColumnReader& r,
           const ColumnReader& z) {
    const std::int32_t column = block.column * block_side - 1, row = block.row * block_side - 1;
    const double *x = r.data(), *y = z.data();
    const std::size_t size = chunk.size();
#pragma GCC ivdep
    for (std::size_t k = 0; k < size; ++k) {
      const auto wr = Shape::at(x[k] * per_cell, half), wz = Shape::at(y[k] * per_cell, half);
      entry_[k] = (wz.first - row) * tile_columns + (wr.first - column);
      store(wr, 0, k, std::make_index_sequence<count>{});
      store(wz, 1, k, std::make_index_sequence<count>{});
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
  /// A loop inside a loop would not be vectorised.
  template <std::size_t... a>
  void store(const Weights1<Shape::count>& w, std::size_t axis, std::size_t k, std::index_sequence<a...>) {
    ((value_[axis][a][k] = w.value[a], slope_[axis][a][k] = w.slope[a]), ...);
  }

  std::int32_t entry_[Chunk::capacity];
  alignas(64) double value_[2][count][Chunk::capacity], slope_[2][count][Chunk::capacity];
};

}  // namespace vitrum::mpm
