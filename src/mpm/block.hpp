#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace vitrum::mpm {

/// Nodes and cells come in square blocks of this side.
inline constexpr int block_side = 8;
inline constexpr int block_nodes = block_side * block_side;

/// A square of block_side x block_side nodes (and the cells to their upper right) of one velocity field.
/// Bodies of different fields share no node, wherever they are.
struct Block {
  std::int32_t column = 0, row = 0;  ///< block coordinates: node (8 column, 8 row) is its first
  std::int32_t field = 0;            ///< Body::field of its particles
  std::array<std::int32_t, 9>
      neighbours{};          ///< index of the block at (di, dj) in 3 (dj + 1) + di + 1; -1: absent
  std::int32_t tile = -1;    ///< index of its tile; -1: holds no particle
  bool constrained = false;  ///< some node is held
  std::array<std::int64_t, 4>
      cells{};  ///< first and last cell column, first and last row its particles may be in
};

/// Which block: by place and velocity field.
struct BlockKey {
  std::int32_t column, row, field;
  bool operator==(const BlockKey&) const = default;

  struct Hash {
    std::size_t operator()(const BlockKey& key) const {
      const auto place = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(key.row)) << 32) |
                         static_cast<std::uint32_t>(key.column);
      return std::hash<std::uint64_t>{}(place ^ (static_cast<std::uint64_t>(key.field) << 48));
    }
  };
};
inline BlockKey key_of(const Block& b) {
  return {b.column, b.row, b.field};
}

/// The positions that lie in the cells that a block's particles may be in. A comparison of doubles: it holds
/// for positions that no integer can hold, and is false for what is not a number.
class CellRange {
 public:
  CellRange(const Block& b, double per_cell)
      : per_cell_(per_cell),
        min_{static_cast<double>(b.cells[0]), static_cast<double>(b.cells[2])},
        max_{static_cast<double>(b.cells[1] + 1), static_cast<double>(b.cells[3] + 1)} {}

  bool contain(double x0, double x1) const {
    const double c0 = x0 * per_cell_, c1 = x1 * per_cell_;
    return (c0 >= min_[0]) & (c0 < max_[0]) & (c1 >= min_[1]) & (c1 < max_[1]);
  }

 private:
  double per_cell_, min_[2], max_[2];
};

}  // namespace vitrum::mpm
