#pragma once
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "mpm/grid.hpp"

/// Which block a cell belongs to, and which cells a block's particles are in.
namespace vitrum::mpm {

/// floor(cell / block_side)
inline std::int32_t block_of(std::int64_t cell) {
  return static_cast<std::int32_t>(cell >> 3);
}

/// The order of blocks: by rows, or by columns; those of several velocity fields one after the other.
struct Before {
  bool by_row;
  bool operator()(const Block& a, const Block& b) const {
    const auto place = [this](const Block& block) {
      return by_row ? std::array{block.row, block.column, block.field}
                    : std::array{block.column, block.row, block.field};
    };
    return place(a) < place(b);
  }
};

inline bool holds(const Block& b, std::int64_t i, std::int64_t j, std::int32_t field) {
  return b.column == block_of(i) && b.row == block_of(j) && b.field == field;
}

/// The block of a velocity field with cell (i, j), for particles in that cell and beside it.
inline Block block_at(std::int64_t i, std::int64_t j, std::int32_t field) {
  Block b;
  b.column = block_of(i), b.row = block_of(j), b.field = field;
  b.cells = {i, i, j, j};
  return b;
}

/// Extends the range of cells of a block to cell (i, j) of it and its neighbours in the block: particles may
/// move by up to a cell before their lists must be looked through. Returns whether the range was smaller
/// before; does not write to the block otherwise (it may be in the cache of another thread).
inline bool widen(Block& b, std::int64_t i, std::int64_t j) {
  const std::int64_t i0 = std::int64_t{b.column} * block_side, j0 = std::int64_t{b.row} * block_side;
  const std::array<std::int64_t, 4> cells{
      std::min(b.cells[0], std::max(i - 1, i0)), std::max(b.cells[1], std::min(i + 1, i0 + block_side - 1)),
      std::min(b.cells[2], std::max(j - 1, j0)), std::max(b.cells[3], std::min(j + 1, j0 + block_side - 1))};
  if (cells == b.cells) return false;
  b.cells = cells;
  return true;
}

/// Whether a coordinate (in cells) is that of a cell: finite, and block coordinates are 32-bit.
inline constexpr double farthest_cell = 2147483000.0;
inline bool is_in_cell(double x) {
  return std::abs(x) < farthest_cell;
}
/// The cell of a coordinate (in cells). Throws ComputationError where there is none.
std::int64_t checked_cell(double x, const Body& body, std::size_t particle);

}  // namespace vitrum::mpm
