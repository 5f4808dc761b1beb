#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mpm/blocks.hpp"
#include "mpm/computation_error.hpp"

namespace vitrum::mpm {

std::int64_t checked_cell(double x, const Body& body, std::size_t particle) {
  if (!is_in_cell(x))
    throw ComputationError(
        fmt::format("body '{}', particle {}: position is {} cells from the origin; it must be finite and "
                    "within {:.3g} cells (an unstable step scatters particles: reduce the step)",
                    body.name, body.particles.identity[particle], x, farthest_cell));
  return cell_of(x);
}

bool Grid::some_left() const {
  return std::any_of(moved_.begin(), moved_.end(), [](const MovesOfTile& tile) { return tile.some(); });
}

void Grid::note_moved(std::size_t tile, const std::vector<Body>& bodies, bool may_have_left) {
  moved_[tile].forget_movers();
  if (may_have_left) find_movers(tile, bodies);
}

/// Finds the particles that have left the block of a tile, in the order of their lists. The cells of the
/// block are widened where particles have only spread.
void Grid::find_movers(std::size_t tile, const std::vector<Body>& bodies) {
  Block& block = blocks_[tile];
  MovesOfTile& moved = moved_[tile];
  const double per_cell = 1.0 / cell_;
  CellRange cells(block, per_cell);
  for (std::size_t n = 0; n < body_count_; ++n) {
    const Particles& p = bodies[n].particles;
    const auto list = static_cast<std::uint32_t>(tile * body_count_ + n);
    const Range range = particles(tile, n);
    for (const std::uint32_t* at = range.begin; at != range.end; ++at) {
      const double x0 = p.position[0][*at], x1 = p.position[1][*at];
      if (cells.contain(x0, x1)) continue;
      if (!is_in_cell(x0 * per_cell) || !is_in_cell(x1 * per_cell)) {
        moved.lost = true;
        continue;
      }
      const std::int64_t i = cell_of(x0 * per_cell), j = cell_of(x1 * per_cell);
      if (holds(block, i, j, block.field)) {
        moved.wider |= widen(block, i, j);
        cells = CellRange(block, per_cell);
      } else {
        moved.movers.push_back({list, 0, static_cast<std::uint32_t>(at - range.begin), *at, p.identity[*at],
                                static_cast<std::int32_t>(i), static_cast<std::int32_t>(j)});
      }
    }
  }
}

void Grid::relist(const std::vector<Body>& bodies, parallel::ThreadTeam& team) {
  const auto threads = static_cast<std::size_t>(team.size());
  found_.resize(threads);
  team.on_each_thread([&](std::size_t thread) {
    collect_movers(first_tile_of(thread, threads), first_tile_of(thread + 1, threads), found_[thread]);
  });
  // Only making all lists anew tells the same lost particle whichever tile it was in.
  if (std::any_of(found_.begin(), found_.end(), [](const MovesOfThread& f) { return f.lost; }))
    return rebuild(bodies);
  movers_.clear();
  for (const MovesOfThread& f : found_) movers_.insert(movers_.end(), f.movers.begin(), f.movers.end());
  const bool serve = blocks_serve();
  if (serve && movers_.empty()) return;
  old_.offset.swap(offset_), old_.index.swap(index_), old_.list.clear();
  index_.resize(old_.index.size());
  offset_.resize(old_.offset.size()), offset_.back() = old_.offset.back();
  if (!serve) renew_blocks();
  sort_movers();
  team.on_each_thread([&](std::size_t thread) {
    const std::size_t first = first_tile_of(thread, threads), last = first_tile_of(thread + 1, threads);
    if (serve) shift_lists(first * body_count_, last * body_count_);
    found_[thread].scattered = 0;
    for (std::size_t tile = first; tile < last; ++tile) {
      // (Where a list ends is where the next begins, which another thread may be about to find.)
      for (std::size_t n = 0; n < body_count_; ++n)
        found_[thread].scattered += scattered_in(merge_list(tile * body_count_ + n, bodies[n].particles));
    }
  });
  scattered_ = 0;
  for (const MovesOfThread& f : found_) scattered_ += f.scattered;
}

/// Gathers the movers of the tiles [first, last), with the lists that they go to as blocks are now.
void Grid::collect_movers(std::size_t first, std::size_t last, MovesOfThread& found) {
  found.movers.clear();
  found.lost = false, found.blocks_serve = true;
  for (std::size_t tile = first; tile < last; ++tile) {
    MovesOfTile& moved = moved_[tile];
    if (!moved.some()) continue;
    found.lost |= moved.lost;
    if (moved.wider) found.blocks_serve &= has_neighbours(blocks_[tile]);
    const std::size_t listed = offset_[(tile + 1) * body_count_] - offset_[tile * body_count_];
    if (moved.movers.size() == listed) found.blocks_serve = false;  // unless others come, the block is empty
    for (Mover m : moved.movers) {
      const std::int32_t to = destination(m);
      if (to < 0) found.blocks_serve = false;
      m.to = static_cast<std::uint32_t>(to) * static_cast<std::uint32_t>(body_count_) +
             m.from % static_cast<std::uint32_t>(body_count_);
      found.movers.push_back(m);
    }
    moved.clear();
  }
}

/// The tile of a block; -1: none.
std::int32_t Grid::tile_of(const BlockKey& key) const {
  const auto entry = find_.find(key);
  return entry == find_.end() ? -1 : blocks_[static_cast<std::size_t>(entry->second)].tile;
}

/// The tile that a mover goes to, as blocks are now; -1: none.
std::int32_t Grid::destination(const Mover& m) const {
  const Block& from = blocks_[m.from / body_count_];
  const std::int64_t di = std::int64_t{block_of(m.i)} - from.column,
                     dj = std::int64_t{block_of(m.j)} - from.row;
  if (std::max(std::abs(di), std::abs(dj)) > 1) return tile_of({block_of(m.i), block_of(m.j), from.field});
  const std::int32_t block = from.neighbours[static_cast<std::size_t>(3 * (dj + 1) + di + 1)];
  return block < 0 ? -1 : blocks_[static_cast<std::size_t>(block)].tile;
}

/// Whether all blocks are there whose nodes the particles of a block may touch.
bool Grid::has_neighbours(const Block& block) const {
  const auto [left, right, down, up] = reach(block);
  for (int dj = down; dj <= up; ++dj)
    for (int di = left; di <= right; ++di)
      if (block.neighbours[static_cast<std::size_t>(3 * (dj + 1) + di + 1)] < 0) return false;
  return true;
}

/// Whether the blocks there are can take the movers: none is new, none is empty afterwards, and none reaches
/// for nodes that are not there. Widens their cells.
bool Grid::blocks_serve() {
  if (!std::all_of(found_.begin(), found_.end(), [](const MovesOfThread& f) { return f.blocks_serve; }))
    return false;
  return std::all_of(movers_.begin(), movers_.end(), [&](const Mover& m) {
    Block& to = blocks_[m.to / body_count_];
    return !widen(to, m.i, m.j) || has_neighbours(to);
  });
}

/// The blocks that hold particles once the movers have moved.
std::vector<Block> Grid::blocks_after_moves() const {
  std::vector<std::int64_t> size(tile_block_.size());
  for (std::size_t tile = 0; tile < size.size(); ++tile)
    size[tile] = std::int64_t{old_.offset[(tile + 1) * body_count_]} - old_.offset[tile * body_count_];
  std::vector<Block> after(blocks_.begin(), blocks_.begin() + static_cast<std::ptrdiff_t>(size.size()));
  std::unordered_map<BlockKey, std::size_t, BlockKey::Hash> place;
  for (std::size_t tile = 0; tile < size.size(); ++tile) place[key_of(after[tile])] = tile;
  for (const Mover& m : movers_) {
    const std::int32_t field = blocks_[m.from / body_count_].field;
    const auto [entry, added] = place.try_emplace({block_of(m.i), block_of(m.j), field}, after.size());
    if (added) after.push_back(block_at(m.i, m.j, field)), size.push_back(0);
    widen(after[entry->second], m.i, m.j);
    --size[m.from / body_count_], ++size[entry->second];
  }
  std::size_t kept = 0;
  for (std::size_t n = 0; n < after.size(); ++n)
    if (size[n] > 0) after[kept++] = after[n];
  after.resize(kept);
  return after;
}

/// Makes the blocks that hold particles once the movers have moved, finds which of the old lists each list
/// comes of and where it begins, and enters where the movers go.
void Grid::renew_blocks() {
  const std::vector<Block> old(blocks_.begin(),
                               blocks_.begin() + static_cast<std::ptrdiff_t>(tile_block_.size()));
  set_blocks(blocks_after_moves());
  offset_.assign(tile_block_.size() * body_count_ + 1, 0);
  old_.list.assign(offset_.size() - 1, -1);
  std::vector<std::int32_t> rank(old.size());  // old tile -> new tile; -1: holds no particle any more
  for (std::size_t tile = 0; tile < old.size(); ++tile) {
    rank[tile] = tile_of(key_of(old[tile]));
    for (std::size_t n = 0; rank[tile] >= 0 && n < body_count_; ++n) {
      const std::size_t from = tile * body_count_ + n,
                        to = static_cast<std::size_t>(rank[tile]) * body_count_ + n;
      old_.list[to] = static_cast<std::ptrdiff_t>(from);
      offset_[to + 1] = old_.offset[from + 1] - old_.offset[from];
    }
  }
  for (Mover& m : movers_) {
    const std::size_t body = m.from % body_count_;
    if (const std::int32_t stays = rank[m.from / body_count_]; stays >= 0)
      --offset_[static_cast<std::size_t>(stays) * body_count_ + body + 1];
    const auto tile =
        static_cast<std::size_t>(tile_of({block_of(m.i), block_of(m.j), old[m.from / body_count_].field}));
    m.to = static_cast<std::uint32_t>(tile * body_count_ + body);
    ++offset_[m.to + 1];
  }
  std::partial_sum(offset_.begin(), offset_.end(), offset_.begin());
}

void Grid::sort_movers() {
  leavers_.clear(), comers_.clear();
  for (const Mover& m : movers_)
    leavers_.push_back({m.from, m.place}), comers_.push_back({m.to, m.identity, m.particle});
  std::sort(comers_.begin(), comers_.end(), [](const Comer& a, const Comer& b) {
    return a.list != b.list ? a.list < b.list : a.identity < b.identity;
  });
}

/// Finds where the lists [first, last) begin: as before, but for those who left and came before them.
void Grid::shift_lists(std::size_t first, std::size_t last) {
  const auto before = [](const auto& mover, std::size_t list) { return mover.list < list; };
  auto leaver = std::lower_bound(leavers_.begin(), leavers_.end(), first, before);
  auto comer = std::lower_bound(comers_.begin(), comers_.end(), first, before);
  for (std::size_t list = first; list < last; ++list) {
    offset_[list] = static_cast<std::uint32_t>(old_.offset[list] + (comer - comers_.begin()) -
                                               (leaver - leavers_.begin()));
    while (leaver != leavers_.end() && leaver->list == list) ++leaver;
    while (comer != comers_.end() && comer->list == list) ++comer;
  }
}

/// Makes a list of the old one, without those who left and with those who came, by rising identity.
Grid::Range Grid::merge_list(std::size_t list, const Particles& p) {
  const auto those_of = [](const auto& movers, std::size_t of) {
    const auto first = std::lower_bound(movers.begin(), movers.end(), of,
                                        [](const auto& m, std::size_t l) { return m.list < l; });
    return std::pair(first, std::find_if(first, movers.end(), [of](const auto& m) { return m.list != of; }));
  };
  auto [comer, last_comer] = those_of(comers_, list);
  std::uint32_t *const merged = index_.data() + offset_[list], *to = merged;
  const std::ptrdiff_t old = old_.list.empty() ? static_cast<std::ptrdiff_t>(list) : old_.list[list];
  if (old < 0) {
    for (; comer != last_comer; ++comer) *to++ = comer->particle;
    return {merged, to};
  }
  const auto from = static_cast<std::size_t>(old);
  auto [leaver, last_leaver] = those_of(leavers_, from);
  const std::uint32_t *const begin = old_.index.data() + old_.offset[from],
                             *const end = old_.index.data() + old_.offset[from + 1], *at = begin;
  // Where the next one comes in, among those who were there.
  const auto place_of_comer = [&] {
    return comer == last_comer ? end
                               : std::lower_bound(at, end, comer->identity,
                                                  [&](std::uint32_t particle, std::uint32_t identity) {
                                                    return p.identity[particle] < identity;
                                                  });
  };
  const std::uint32_t* entry = place_of_comer();
  for (; leaver != last_leaver || comer != last_comer;) {
    const bool leaves = leaver != last_leaver && begin + leaver->place < entry;
    const std::uint32_t* next = leaves ? begin + leaver->place : entry;
    to = std::copy(at, next, to);
    at = next;
    if (leaves) {
      ++at, ++leaver;
    } else {
      *to++ = comer->particle;
      ++comer;
      entry = place_of_comer();
    }
  }
  return {merged, std::copy(at, end, to)};
}

}  // namespace vitrum::mpm
