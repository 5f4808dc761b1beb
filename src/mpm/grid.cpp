#include "mpm/grid.hpp"

#include <algorithm>
#include <numeric>

#include "mpm/blocks.hpp"
#include "mpm/chunk.hpp"

namespace vitrum::mpm {
namespace {

std::size_t count_distinct(std::vector<std::int32_t>& values) {
  std::sort(values.begin(), values.end());
  return static_cast<std::size_t>(std::unique(values.begin(), values.end()) - values.begin());
}

/// Whether the blocks lie in at least as many rows as columns.
bool are_tall(const std::vector<Block>& blocks) {
  std::vector<std::int32_t> rows, columns;
  for (const Block& b : blocks) rows.push_back(b.row), columns.push_back(b.column);
  return count_distinct(rows) >= count_distinct(columns);
}

}  // namespace

void Grid::rebuild(const std::vector<Body>& bodies) {
  body_count_ = bodies.size();
  find_blocks(bodies);
  fill_lists(bodies);
}

bool Grid::has_left(std::size_t tile, const std::vector<Body>& bodies) const {
  const CellRange cells(blocks_[static_cast<std::size_t>(tile_block_[tile])], 1.0 / cell_);
  int outside = 0;
  for (std::size_t n = 0; n < bodies.size() && outside == 0; ++n)
    for_chunks(*this, tile, n, [&](const Chunk& chunk) {
      const ColumnReader r(chunk, bodies[n].particles.position[0]), z(chunk, bodies[n].particles.position[1]);
      const double *x0 = r.data(), *x1 = z.data();
#pragma omp simd reduction(| : outside)
      for (std::size_t k = 0; k < chunk.size(); ++k) outside |= cells.contain(x0[k], x1[k]) ? 0 : 1;
    });
  return outside != 0;
}

/// Finds the blocks that hold particles, each particle's block (home_), and each block's range of cells.
void Grid::find_blocks(const std::vector<Body>& bodies) {
  std::size_t total = 0;
  for (const Body& body : bodies) total += body.on_grid();
  home_.resize(total);
  std::vector<Block> met;
  find_.clear();
  const double per_cell = 1.0 / cell_;
  std::size_t k = 0;
  for (const Body& body : bodies) {
    std::int32_t last = -1;
    for (std::size_t p = 0; p < body.on_grid(); ++p, ++k) {
      const std::int64_t i = checked_cell(body.particles.position[0][p] * per_cell, body, p);
      const std::int64_t j = checked_cell(body.particles.position[1][p] * per_cell, body, p);
      const std::int32_t field = body.field_of(p);
      if (last < 0 || !holds(met[static_cast<std::size_t>(last)], i, j, field)) {
        const auto [entry, added] =
            find_.try_emplace({block_of(i), block_of(j), field}, static_cast<std::int32_t>(met.size()));
        if (added) met.push_back(block_at(i, j, field));
        last = entry->second;
      }
      widen(met[static_cast<std::size_t>(last)], i, j);
      home_[k] = last;
    }
  }
  // In geometric order, so that sums over blocks do not depend on the order in which blocks were met.
  std::vector<Block> sorted = met;
  set_blocks(std::move(sorted));
  std::vector<std::int32_t> rank(met.size());
  for (std::size_t n = 0; n < met.size(); ++n) rank[n] = find_.at(key_of(met[n]));
  for (std::int32_t& home : home_) home = rank[static_cast<std::size_t>(home)];
}

/// Counting sort by (tile, body); within a list by identity, so that sums do not depend on the storage.
void Grid::fill_lists(const std::vector<Body>& bodies) {
  index_.resize(home_.size());
  offset_.assign(tile_block_.size() * body_count_ + 1, 0);
  std::size_t k = 0;
  for (std::size_t body = 0; body < body_count_; ++body)
    for (std::size_t p = 0; p < bodies[body].on_grid(); ++p, ++k)
      ++offset_[static_cast<std::size_t>(home_[k]) * body_count_ + body + 1];
  std::partial_sum(offset_.begin(), offset_.end(), offset_.begin());
  std::vector<std::uint32_t> next(offset_.begin(), offset_.end() - 1);
  k = 0;
  for (std::size_t body = 0; body < body_count_; ++body)
    if (!bodies[body].coasting) k = append(bodies[body], body, k, next);
  scattered_ = 0;
  for (std::size_t tile = 0; tile < tile_block_.size(); ++tile)
    for (std::size_t body = 0; body < body_count_; ++body) scattered_ += scattered_in(particles(tile, body));
}

std::size_t Grid::scattered_in(Range list) {
  std::size_t scattered = 0;
  for (const std::uint32_t* at = list.begin; at < list.end; at += Chunk::capacity) {
    const std::size_t size = std::min(static_cast<std::size_t>(list.end - at), Chunk::capacity);
    if (!Chunk::consecutive(at, size)) scattered += size;
  }
  return scattered;
}

/// Enters the particles of a body into their lists by rising identity. number: the body's; home: place of its
/// first entry in home_; returns that of the next body's.
std::size_t Grid::append(const Body& body, std::size_t number, std::size_t home,
                         std::vector<std::uint32_t>& next) {
  const Particles& p = body.particles;
  const auto enter = [&](std::uint32_t particle) {
    const auto tile = static_cast<std::size_t>(home_[home + particle]);
    index_[next[tile * body_count_ + number]++] = particle;
  };
  const auto size = static_cast<std::uint32_t>(p.size), present = static_cast<std::uint32_t>(body.present());
  if (std::is_sorted(p.identity.begin(), p.identity.end())) {
    for (std::uint32_t i = 0; i < present; ++i) enter(i);
  } else {
    place_.resize(size);
    for (std::uint32_t i = 0; i < size; ++i) place_[p.identity[i]] = i;
    for (std::uint32_t identity = 0; identity < size; ++identity)
      if (place_[identity] < present) enter(place_[identity]);
  }
  return home + present;
}

/// Makes these the blocks that hold particles; adds those whose nodes their particles may touch.
void Grid::set_blocks(std::vector<Block>&& with_particles) {
  blocks_ = std::move(with_particles);
  const bool by_row = are_tall(blocks_);
  std::sort(blocks_.begin(), blocks_.end(), Before{by_row});
  find_.clear();
  tile_block_.resize(blocks_.size());
  std::iota(tile_block_.begin(), tile_block_.end(), 0);
  for (std::int32_t n : tile_block_) {
    Block& b = blocks_[static_cast<std::size_t>(n)];
    b.tile = n;
    find_[key_of(b)] = n;
  }
  moved_.resize(tile_block_.size());
  for (MovesOfTile& tile : moved_) tile.clear();
  add_neighbours(by_row);
  std::vector<std::int32_t> lines;
  for (const Block& b : blocks_) lines.push_back(by_row ? b.row : b.column);
  strips_.set(lines, tile_block_.size());
  mark_constraints();
  make_room();
}

/// Room for the nodes' values of the fields that are wanted.
void Grid::make_room() {
  for (std::size_t field = 0; field < field_count; ++field)
    if (field < first_sum ||
        (field >= first_centroid ? keeps_centroids_
                                 : keeps_sums_ || (field >= first_force && !boundaries_.empty())))
      fields_[field].resize(blocks_.size() * block_nodes);
}

void Grid::keep_sums() {
  keeps_sums_ = true;
  make_room();
}

void Grid::keep_centroids() {
  keeps_centroids_ = true;
  make_room();
}

void Grid::provide_tile_data(std::size_t strips) {
  const std::size_t most = strips_.most_tiles_in(strips);
  tile_place_.resize(tile_block_.size());
  std::size_t places = 0;
  for (std::size_t thread = 0; thread + 1 < shares_.size(); ++thread) {
    const std::size_t first = shares_[thread], last = shares_[thread + 1],
                      room = std::min(most, last - first);
    for (std::size_t tile = first, place = 0; tile < last; ++tile) {
      // (Other threads have this in their caches: it is not written without need.)
      const auto at = static_cast<std::uint32_t>(places + place);
      if (tile_place_[tile] != at) tile_place_[tile] = at;
      if (++place == room) place = 0;
    }
    places += room;
  }
  if (tile_data_.size() < places) tile_data_.resize(places);
}

void Grid::share_tiles(std::span<const std::size_t> shares) {
  shares_.clear();
  for (const std::size_t piece : shares)
    shares_.push_back(piece == strips_.pieces.size() ? tile_block_.size() : strips_.pieces[piece].first_tile);
}

/// The first tile of a thread's share, as tiles are now (they may have become others since); thread ==
/// threads: the end.
std::size_t Grid::first_tile_of(std::size_t thread, std::size_t threads) const {
  if (thread == threads) return tile_block_.size();
  if (shares_.size() != threads + 1) return tile_block_.size() * thread / threads;
  return std::min(shares_[thread], tile_block_.size());
}

/// By how many blocks to the left, right, below and above the nodes lie that a block's particles may touch.
std::array<int, 4> Grid::reach(const Block& b) const {
  const bool wide = shape_ != ShapeKind::linear;
  const std::int64_t i0 = std::int64_t{b.column} * block_side, j0 = std::int64_t{b.row} * block_side;
  const std::int64_t last =
      block_side - (wide ? 2 : 1);  // from this cell on, the next block's nodes are touched
  const bool left = wide && b.cells[0] == i0 && !(axisymmetric_ && b.column == 0);
  return {left ? -1 : 0, b.cells[1] - i0 >= last ? 1 : 0, wide && b.cells[2] == j0 ? -1 : 0,
          b.cells[3] - j0 >= last ? 1 : 0};
}

/// Adds the blocks whose nodes particles of other blocks may touch, and links all blocks.
void Grid::add_neighbours(bool by_row) {
  const std::size_t with_particles = blocks_.size();
  for (std::size_t n = 0; n < with_particles; ++n) {
    const Block b = blocks_[n];
    const auto [left, right, down, up] = reach(b);
    for (int dj = down; dj <= up; ++dj)
      for (int di = left; di <= right; ++di) {
        const auto [entry, added] = find_.try_emplace({b.column + di, b.row + dj, b.field},
                                                      static_cast<std::int32_t>(blocks_.size()));
        if (added) {
          blocks_.emplace_back();
          blocks_.back().column = b.column + di, blocks_.back().row = b.row + dj;
          blocks_.back().field = b.field;
        }
      }
  }
  // In geometric order too: what is summed over blocks must not depend on the particles that asked for them.
  std::sort(blocks_.begin() + static_cast<std::ptrdiff_t>(with_particles), blocks_.end(), Before{by_row});
  for (std::size_t n = with_particles; n < blocks_.size(); ++n)
    find_[key_of(blocks_[n])] = static_cast<std::int32_t>(n);
  for (Block& b : blocks_)
    for (int dj = -1; dj <= 1; ++dj)
      for (int di = -1; di <= 1; ++di) {
        const auto entry = find_.find({b.column + di, b.row + dj, b.field});
        b.neighbours[static_cast<std::size_t>(3 * (dj + 1) + di + 1)] =
            entry == find_.end() ? -1 : entry->second;
      }
}

}  // namespace vitrum::mpm
