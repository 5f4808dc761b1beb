#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

// Particles on their way from one list of the grid to another: what Grid::relist works on.

namespace vitrum::mpm {

/// A particle that has left its block.
struct Mover {
  std::uint32_t from, to;  ///< lists: tile * bodies + body
  std::uint32_t place;     ///< in the list that it leaves
  std::uint32_t particle, identity;
  std::int32_t i, j;  ///< its cell
};
/// The same as the lists see it; small, because all threads read it.
struct Leaver {
  std::uint32_t list, place;
};
struct Comer {
  std::uint32_t list, identity, particle;
};
/// What has become of the particles of a tile.
struct alignas(64) MovesOfTile {
  std::vector<Mover> movers;
  bool wider = false;  ///< the cells of the block have been widened since the lists were made
  bool lost = false;   ///< some position is no cell's
  void forget_movers() {
    if (some()) movers.clear(), lost = false;
  }
  void clear() {
    if (some()) movers.clear(), wider = lost = false;
  }
  bool some() const { return !movers.empty() || wider || lost; }
};
/// What has become of the particles of a thread's tiles.
struct alignas(64) MovesOfThread {
  std::vector<Mover> movers;
  bool lost = false;  ///< some position is no cell's
  /// The blocks there are can take those who have moved, as far as these tiles tell.
  bool blocks_serve = true;
  std::size_t scattered = 0;
};
/// The lists as they were.
struct FormerLists {
  std::vector<std::uint32_t> offset, index;
  std::vector<std::ptrdiff_t> list;  ///< by list that is now: the one it comes of; -1: none; empty: itself
};

}  // namespace vitrum::mpm
