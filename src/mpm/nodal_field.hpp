#pragma once
#include <cstddef>

#include "mpm/block.hpp"
#include "mpm/pack.hpp"

// What nodes hold: the fields of a step, and what particles add up for them tile by tile.

namespace vitrum::mpm {

/// Per-node quantities of a step.
enum class Field : std::size_t {
  mass,
  velocity_0,  ///< before the forces act, boundary values imposed
  velocity_1,
  new_velocity_0,  ///< after
  new_velocity_1,
  momentum_0,  ///< these two only where someone asks for sums (Grid::keep_sums)
  momentum_1,
  force_0,  ///< and these, also where boundaries push
  force_1,
  centroid_0,  ///< of what a node has collected, cells from the node; only on demand (Grid::keep_centroids)
  centroid_1,
  // Rates have no new velocities: accelerations (m/s^2) take their place.
  acceleration_0 = new_velocity_0,
  acceleration_1 = new_velocity_1,
};
inline constexpr std::size_t field_count = 11;
inline constexpr std::size_t first_sum = 5, first_force = 7, first_centroid = 9;  // of these

/// A block's tile: the nodes that particles of its cells can touch, columns and rows -1 .. 9 (one spare
/// column for alignment).
inline constexpr int tile_columns = 12, tile_rows = 11, tile_nodes = tile_columns * tile_rows;

/// What the particles of one block's cells add to the nodes that they touch. The vectors of a node lie side
/// by side, because a particle's contribution to all of them is computed as one.
struct alignas(64) TileData {
  Pack<4> vectors[tile_nodes];
  double mass[tile_nodes];

  /// One (width 2) or two (width 4) vectors a node.
  template <int width>
  Pack<width>* packs() {
    return reinterpret_cast<Pack<width>*>(vectors);
  }
  template <int width>
  const Pack<width>* packs() const {
    return reinterpret_cast<const Pack<width>*>(vectors);
  }
};

}  // namespace vitrum::mpm
