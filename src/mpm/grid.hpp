#pragma once
#include <array>
#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "mpm/block.hpp"
#include "mpm/boundary.hpp"
#include "mpm/constraint.hpp"
#include "mpm/movers.hpp"
#include "mpm/nodal_field.hpp"
#include "mpm/particles.hpp"
#include "mpm/shape.hpp"
#include "parallel/strips.hpp"
#include "parallel/thread_team.hpp"

namespace vitrum::mpm {

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
  /// To be told by who else moves them.
  void note_sorted() { ++times_sorted_; }

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
  void find_blocks(const std::vector<Body>& bodies);
  void fill_lists(const std::vector<Body>& bodies);
  std::size_t append(const Body& body, std::size_t number, std::size_t home,
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
  void collect_movers(std::size_t first, std::size_t last, MovesOfThread& found);
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
  std::vector<MovesOfTile> moved_;             // by tile
  std::size_t scattered_ = 0, times_sorted_ = 0;
  std::vector<std::int32_t> home_;    // scratch: block of each particle
  std::vector<std::uint32_t> place_;  // scratch: place of each identity
  std::vector<MovesOfThread> found_;  // scratch: by thread
  std::vector<Mover> movers_;         // scratch: by the list left and the place there
  std::vector<Leaver> leavers_;       // scratch: by list and place
  std::vector<Comer> comers_;         // scratch: by list and identity
  FormerLists old_;                   // scratch
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
