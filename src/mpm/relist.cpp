#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mpm/blocks.hpp"
#include "mpm/computation_error.hpp"

namespace vitrum::mpm {

std::int64_t checked_cell(double x, const Body& body, std::size_t particle) {
  constexpr double limit = 2147483000.0;  // cells; block coordinates are 32-bit
  if (!(std::abs(x) < limit))
    throw ComputationError(
        fmt::format("body '{}', particle {}: position is {} cells from the origin; it must be finite and "
                    "within {:.3g} cells (an unstable step scatters particles: reduce the step)",
                    body.name, body.particles.identity[particle], x, limit));
  return cell_of(x);
}

bool Grid::some_left() const {
  return std::any_of(left_.begin(), left_.end(), [](char left) { return left != 0; });
}

void Grid::relist(const std::vector<Body>& bodies, ThreadTeam& team) {
  try {
    find_movers(bodies, team);
  } catch (const ComputationError&) {
    rebuild(bodies);  // throws for the same particle whichever thread came first
    throw;
  }
  std::vector<std::int32_t> rank(tile_block_.size());  // old tile -> new tile; -1: holds no particle any more
  std::iota(rank.begin(), rank.end(), 0);
  if (!blocks_serve()) {
    const std::vector<Block> old(blocks_.begin(), blocks_.begin() + static_cast<std::ptrdiff_t>(rank.size()));
    set_blocks(blocks_after_moves());
    for (std::size_t tile = 0; tile < old.size(); ++tile)
      rank[tile] = tile_of(old[tile].column, old[tile].row);
  }
  for (Mover& m : movers_)
    m.to =
        static_cast<std::size_t>(tile_of(block_of(m.i), block_of(m.j))) * body_count_ + m.from % body_count_;
  move_between_lists(rank, bodies, team);
  std::fill(left_.begin(), left_.end(), char{0});
}

/// The tile of a block; -1: none.
std::int32_t Grid::tile_of(std::int32_t column, std::int32_t row) const {
  const auto entry = find_.find(key_of(column, row));
  return entry == find_.end() ? -1 : blocks_[static_cast<std::size_t>(entry->second)].tile;
}

/// Finds the particles that have left their blocks, in the order of their lists. The cells of blocks whose
/// particles have only spread are widened.
void Grid::find_movers(const std::vector<Body>& bodies, ThreadTeam& team) {
  movers_of_tile_.resize(tile_block_.size());
  team.for_each_chunk(tile_block_.size(), [&](std::size_t tile) {
    movers_of_tile_[tile].clear();
    if (left_[tile] != 0) find_movers_of(tile, bodies);
  });
  movers_.clear();
  for (const std::vector<Mover>& movers : movers_of_tile_)
    movers_.insert(movers_.end(), movers.begin(), movers.end());
}

void Grid::find_movers_of(std::size_t tile, const std::vector<Body>& bodies) {
  Block& block = blocks_[tile];
  const double per_cell = 1.0 / cell_;
  const CellRange cells(block, per_cell);
  for (std::size_t n = 0; n < body_count_; ++n) {
    const auto& x = bodies[n].particles.position;
    const Range range = particles(tile, n);
    for (const std::uint32_t* at = range.begin; at != range.end; ++at) {
      const double x0 = x[0][*at], x1 = x[1][*at];
      if (cells.contain(x0, x1)) continue;
      const std::int64_t i = checked_cell(x0 * per_cell, bodies[n], *at),
                         j = checked_cell(x1 * per_cell, bodies[n], *at);
      if (holds(block, i, j))
        widen(block, i, j);
      else
        movers_of_tile_[tile].push_back(
            {tile * body_count_ + n, 0, *at, bodies[n].particles.identity[*at], i, j});
    }
  }
}

/// Whether the blocks there are can take the movers: none is new, none is empty afterwards, and none reaches
/// for nodes that are not there. Widens their cells.
bool Grid::blocks_serve() {
  std::vector<std::int64_t> size(tile_block_.size());
  for (std::size_t tile = 0; tile < size.size(); ++tile)
    size[tile] = std::int64_t{offset_[(tile + 1) * body_count_]} - offset_[tile * body_count_];
  for (const Mover& m : movers_) {
    const std::int32_t to = tile_of(block_of(m.i), block_of(m.j));
    if (to < 0) return false;
    widen(blocks_[static_cast<std::size_t>(to)], m.i, m.j);
    --size[m.from / body_count_], ++size[static_cast<std::size_t>(to)];
  }
  for (std::size_t tile = 0; tile < size.size(); ++tile) {
    if (size[tile] == 0) return false;
    const auto [left, right, down, up] = reach(blocks_[tile]);
    for (int dj = down; dj <= up; ++dj)
      for (int di = left; di <= right; ++di)
        if (blocks_[tile].neighbours[static_cast<std::size_t>(3 * (dj + 1) + di + 1)] < 0) return false;
  }
  return true;
}

/// The blocks that hold particles once the movers have moved.
std::vector<Block> Grid::blocks_after_moves() const {
  std::vector<std::int64_t> size(tile_block_.size());
  for (std::size_t tile = 0; tile < size.size(); ++tile)
    size[tile] = std::int64_t{offset_[(tile + 1) * body_count_]} - offset_[tile * body_count_];
  std::vector<Block> after(blocks_.begin(), blocks_.begin() + static_cast<std::ptrdiff_t>(size.size()));
  std::unordered_map<std::uint64_t, std::size_t> place;
  for (std::size_t tile = 0; tile < size.size(); ++tile)
    place[key_of(after[tile].column, after[tile].row)] = tile;
  for (const Mover& m : movers_) {
    const auto [entry, added] = place.try_emplace(key_of(block_of(m.i), block_of(m.j)), after.size());
    if (added) after.push_back(block_at(m.i, m.j)), size.push_back(0);
    widen(after[entry->second], m.i, m.j);
    --size[m.from / body_count_], ++size[entry->second];
  }
  std::size_t kept = 0;
  for (std::size_t n = 0; n < after.size(); ++n)
    if (size[n] > 0) after[kept++] = after[n];
  after.resize(kept);
  return after;
}

/// Lists without those who left and with those who came, by rising identity; all others are copied.
void Grid::move_between_lists(const std::vector<std::int32_t>& rank, const std::vector<Body>& bodies,
                              ThreadTeam& team) {
  old_.offset.swap(offset_), old_.index.swap(index_);
  index_.resize(old_.index.size());
  offset_.assign(tile_block_.size() * body_count_ + 1, 0);
  old_.list.assign(offset_.size() - 1, -1);
  for (std::size_t tile = 0; tile < rank.size(); ++tile)
    for (std::size_t n = 0; rank[tile] >= 0 && n < body_count_; ++n) {
      const std::size_t from = tile * body_count_ + n,
                        to = static_cast<std::size_t>(rank[tile]) * body_count_ + n;
      old_.list[to] = static_cast<std::ptrdiff_t>(from);
      offset_[to + 1] = old_.offset[from + 1] - old_.offset[from];
    }
  for (const Mover& m : movers_) {
    if (const std::int32_t stays = rank[m.from / body_count_]; stays >= 0)
      --offset_[static_cast<std::size_t>(stays) * body_count_ + m.from % body_count_ + 1];
    ++offset_[m.to + 1];
  }
  std::partial_sum(offset_.begin(), offset_.end(), offset_.begin());

  comers_ = movers_;
  std::sort(comers_.begin(), comers_.end(), [](const Mover& a, const Mover& b) {
    return a.to != b.to ? a.to < b.to : a.identity < b.identity;
  });
  scattered_of_tile_.resize(tile_block_.size());
  team.for_each_chunk(tile_block_.size(), [&](std::size_t tile) {
    for (std::size_t n = 0; n < body_count_; ++n) merge_list(tile * body_count_ + n, bodies[n].particles);
    scattered_of_tile_[tile] = scattered_in(tile);
  });
  scattered_ = std::accumulate(scattered_of_tile_.begin(), scattered_of_tile_.end(), std::size_t{0});
}

/// Makes a list of the old one and of those who left and came.
void Grid::merge_list(std::size_t list, const Particles& p) {
  const auto first_of = [](const std::vector<Mover>& movers, std::size_t of, std::size_t Mover::*which) {
    return std::lower_bound(movers.begin(), movers.end(), of,
                            [which](const Mover& m, std::size_t l) { return m.*which < l; });
  };
  // Movers stand in the order of the lists that they left; those of a list in the order in which they stood.
  auto comer = first_of(comers_, list, &Mover::to);
  const auto last_comer = std::find_if(comer, comers_.cend(), [&](const Mover& m) { return m.to != list; });
  const bool is_new = old_.list[list] < 0;
  const std::size_t from = is_new ? 0 : static_cast<std::size_t>(old_.list[list]);
  const std::uint32_t *at = old_.index.data() + old_.offset[from],
                      *end = is_new ? at : old_.index.data() + old_.offset[from + 1];
  auto leaver = is_new ? movers_.cend() : first_of(movers_, from, &Mover::from);
  std::uint32_t* to = index_.data() + offset_[list];
  if (comer == last_comer && (leaver == movers_.cend() || leaver->from != from)) {
    std::copy(at, end, to);
    return;
  }
  for (; at != end; ++at) {
    if (leaver != movers_.cend() && leaver->from == from && leaver->particle == *at) {
      ++leaver;
      continue;
    }
    for (; comer != last_comer && comer->identity < p.identity[*at]; ++comer) *to++ = comer->particle;
    *to++ = *at;
  }
  for (; comer != last_comer; ++comer) *to++ = comer->particle;
}

}  // namespace vitrum::mpm
