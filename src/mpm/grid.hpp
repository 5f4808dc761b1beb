#pragma once
#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <unordered_map>
#include <vector>

#include "mpm/boundary.hpp"
#include "mpm/pack.hpp"
#include "mpm/particles.hpp"
#include "mpm/shape.hpp"
#include "parallel/strips.hpp"
#include "parallel/thread_team.hpp"

namespace vitrum::mpm {

/// Nodes and cells come in square blocks of this side.
inline constexpr int block_side = 8;
inline constexpr int block_nodes = block_side * block_side;
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

/// A component of a node's velocity that is not free.
struct Constraint {
  static constexpr std::int16_t free = -1, axis = -2;  ///< otherwise: index of the boundary
};

/// A node of a tile behind a plane of symmetry and the node that it is the image of: what the image collects
/// goes to the node, and the image moves as the node does, but for the sign of the component across the
/// plane.
struct Image {
  std::uint8_t entry, node;  ///< entries of the tile
  std::uint8_t component;    ///< across the plane
  std::int16_t by;           ///< the boundary that is the plane, or Constraint::axis
};

/// What an image had collected when it was folded onto its node: kg, and N across the plane (per radian or
/// per metre).
struct ImageSums {
  double mass, force;
};

/// Unbounded sparse grid: only blocks that particles touch exist. Also knows which particles are in which
/// block.
class Grid {
 public:
  Grid() = default;
  Grid(double cell, ShapeKind shape, bool axisymmetric, std::vector<Boundary> boundaries);

  /// Sorts the particles into blocks anew. Depends on positions and identities only, not on history or on how
  /// particles are stored. Throws ComputationError for positions that are not finite or too far away (2^31
  /// cells).
  void rebuild(const std::vector<Body>& bodies);
  /// The same lists as rebuild, for the cost of the particles that have left since, as note_moved found: they
  /// must not have moved again. Throws as rebuild; the lists are void then.
  void relist(const std::vector<Body>& bodies, parallel::ThreadTeam& team);
  /// To be called once the particles of a tile have moved, by one thread for each tile. may_have_left: some
  /// particle may be out of the cells that the tile was made for; these are looked for at once, while their
  /// positions are in the cache.
  void note_moved(std::size_t tile, const std::vector<Body>& bodies, bool may_have_left);
  bool some_left() const;

  /// Moves the particles of all bodies in memory so that those of a block lie one behind the other. parts: by
  /// how many of the team's threads, each with a range of tiles; particles that change ranges are held twice
  /// meanwhile. Out of memory, particles are as before and the lists void. (Not between note_moved and
  /// relist.)
  void sort_storage(std::vector<Body>& bodies, parallel::ThreadTeam& team, std::size_t parts);
  /// Particles in chunks that lie otherwise, and all particles.
  std::size_t scattered() const { return scattered_; }
  std::size_t listed() const { return index_.size(); }
  /// How often particles have changed places in memory.
  std::size_t times_sorted() const { return times_sorted_; }

  /// Which tiles each thread has in its cache: those of the pieces of strips from shares[n] on, for thread n.
  void share_tiles(std::span<const std::size_t> shares);

  /// Whether some particle of a tile is no longer in the cells that the tile was made for.
  bool has_left(std::size_t tile, const std::vector<Body>& bodies) const;

  /// Particles of `body` in the block with tile `t`, by rising identity.
  struct Range {
    const std::uint32_t *begin, *end;
  };
  Range particles(std::size_t tile, std::size_t body) const {
    const std::size_t k = tile * body_count_ + body;
    return {index_.data() + offset_[k], index_.data() + offset_[k + 1]};
  }

  /// Particles of all tiles before this one.
  std::size_t listed_before(std::size_t tile) const { return offset_[tile * body_count_]; }

  const std::vector<Block>& blocks() const { return blocks_; }
  const std::vector<std::int32_t>& tiles() const { return tile_block_; }
  const parallel::Strips& strips() const { return strips_; }
  double* field(Field f) { return fields_[static_cast<std::size_t>(f)].data(); }
  const double* field(Field f) const { return fields_[static_cast<std::size_t>(f)].data(); }
  /// Has room for momenta and forces from now on.
  void keep_sums();
  bool keeps_sums() const { return keeps_sums_; }
  /// Has room for centroids from now on.
  void keep_centroids();
  /// The data of a tile. Tiles may share it that a sweep does not need at a time (provide_tile_data).
  TileData& tile_data(std::size_t tile) { return tile_data_[tile_place_[tile]]; }
  /// Room for those tiles of each thread that lie in so many strips one after the other; once the tiles as
  /// they are have been shared.
  void provide_tile_data(std::size_t strips);

  std::int16_t constraint(std::size_t component, std::size_t node) const {
    return constraints_[component][node];
  }
  const std::vector<Boundary>& boundaries() const { return boundaries_; }
  std::vector<Boundary>& boundaries() { return boundaries_; }
  /// Brings the boundaries to where they are at `time` (s). Throws ComputationError where two have met that
  /// contradict each other.
  void move_boundaries(double time);
  /// The first time after `time` at which a boundary comes to hold other nodes; infinite: never.
  double next_boundary_shift(double time) const;
  /// Whole cells that a boundary has gone along a component's axis.
  double shift(std::size_t boundary, std::size_t component) const { return shifts_[boundary][component]; }
  /// The columns (component 0) or rows of nodes that a boundary holds now.
  Rows held_rows(std::size_t boundary, std::size_t component) const;
  /// To be folded in this order, and read in the opposite one.
  std::span<const Image> images(std::size_t tile) const {
    return {images_.data() + first_image_[tile], images_.data() + first_image_[tile + 1]};
  }
  /// What the images of a tile collected last; empty where no boundary mirrors.
  std::span<ImageSums> image_sums(std::size_t tile) {
    return mirrors_ ? std::span(image_sums_).subspan(first_image_[tile], images(tile).size())
                    : std::span<ImageSums>();
  }
  std::span<const ImageSums> image_sums(std::size_t tile) const {
    return const_cast<Grid*>(this)->image_sums(tile);
  }
  /// Whether boundaries may push at nodes of a block, so that their forces are asked for (reactions.hpp).
  bool keeps_forces(std::size_t block) const {
    return !boundaries_.empty() && (blocks_[block].constrained || mirrors_);
  }
  /// Whether some cell of the tile's has no node that is free in some component.
  bool may_carry(std::size_t tile) const { return carries_[tile]; }
  double cell() const { return cell_; }
  bool axisymmetric() const { return axisymmetric_; }
  ShapeKind shape() const { return shape_; }

 private:
  /// A particle that has left its block.
  struct Mover {
    std::uint32_t from, to;  ///< lists: tile * body_count_ + body
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
  struct alignas(64) Moved {
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
  struct alignas(64) Found {
    std::vector<Mover> movers;
    bool lost = false;  ///< some position is no cell's
    /// The blocks there are can take those who have moved, as far as these tiles tell.
    bool blocks_serve = true;
    std::size_t scattered = 0;
  };
  /// The lists as they were.
  struct Lists {
    std::vector<std::uint32_t> offset, index;
    std::vector<std::ptrdiff_t> list;  ///< by list that is now: the one it comes of; -1: none; empty: itself
  };
  void find_blocks(const std::vector<Body>& bodies);
  void fill_lists(const std::vector<Body>& bodies);
  std::size_t append(const Particles& p, std::size_t body, std::size_t home,
                     std::vector<std::uint32_t>& next);
  void set_blocks(std::vector<Block>&& with_particles);
  void add_neighbours(bool by_row);
  std::array<int, 4> reach(const Block& block) const;
  void mark_constraints();
  void hold(std::size_t component, std::size_t node, std::int16_t by);
  void list_images();
  void list_images_of(const Block& block, std::size_t boundary, std::size_t component, int side);
  void find_carrying_tiles();
  static std::size_t scattered_in(Range list);
  void make_room();

  void find_movers(std::size_t tile, const std::vector<Body>& bodies);
  std::int32_t tile_of(const BlockKey& key) const;
  std::int32_t destination(const Mover& mover) const;
  void collect_movers(std::size_t first, std::size_t last, Found& found);
  bool has_neighbours(const Block& block) const;
  bool blocks_serve();
  std::vector<Block> blocks_after_moves() const;
  void renew_blocks();
  std::size_t first_tile_of(std::size_t thread, std::size_t threads) const;
  void sort_movers();
  void shift_lists(std::size_t first, std::size_t last);
  Range merge_list(std::size_t list, const Particles& p);

  double cell_ = 1.0;
  ShapeKind shape_ = ShapeKind::linear;
  bool axisymmetric_ = true;
  std::vector<Boundary> boundaries_;
  std::vector<std::int16_t> by_priority_;      // the boundaries, those that act last
  std::vector<std::array<double, 2>> shifts_;  // of the boundaries, cells

  std::size_t body_count_ = 0;
  std::vector<Block> blocks_;
  std::vector<std::int32_t> tile_block_;  // tile -> block
  parallel::Strips strips_;
  std::vector<std::uint32_t> offset_, index_;  // particles by (tile, body)
  std::vector<std::size_t> shares_;            // first tile of each thread's
  std::vector<Moved> moved_;                   // by tile
  std::size_t scattered_ = 0, times_sorted_ = 0;
  std::vector<std::int32_t> home_;    // scratch: block of each particle
  std::vector<std::uint32_t> place_;  // scratch: place of each identity
  std::vector<Found> found_;          // scratch: by thread
  std::vector<Mover> movers_;         // scratch: by the list left and the place there
  std::vector<Leaver> leavers_;       // scratch: by list and place
  std::vector<Comer> comers_;         // scratch: by list and identity
  Lists old_;                         // scratch
  std::unordered_map<BlockKey, std::int32_t, BlockKey::Hash> find_;
  std::array<std::vector<double>, field_count> fields_;
  std::array<std::vector<std::int16_t>, 2> constraints_;
  std::vector<Image> images_;             // by tile
  std::vector<std::size_t> first_image_;  // of each tile
  bool mirrors_ = false;                  // some image is that of a boundary
  std::vector<ImageSums> image_sums_;     // by image
  std::vector<bool> carries_;             // by tile
  bool keeps_sums_ = false, keeps_centroids_ = false;
  std::vector<TileData> tile_data_;
  std::vector<std::uint32_t> tile_place_;  // of each tile, in tile_data_
};

}  // namespace vitrum::mpm
