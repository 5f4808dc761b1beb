#include "mpm/grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "mpm/computation_error.hpp"

namespace vitrum::mpm {
namespace {

std::uint64_t key_of(std::int32_t column, std::int32_t row) {
  return (static_cast<std::uint64_t>(static_cast<std::uint32_t>(row)) << 32) |
         static_cast<std::uint32_t>(column);
}

bool before(const Block& a, const Block& b) {
  return a.row != b.row ? a.row < b.row : a.column < b.column;
}

/// floor(a / 8)
std::int64_t block_of(std::int64_t cell) {
  return cell >> 3;
}

std::int64_t checked_cell(double x, const Body& body, std::size_t particle) {
  constexpr double limit = 2147483000.0;  // cells; block coordinates are 32-bit
  if (!(std::abs(x) < limit))
    throw ComputationError(
        fmt::format("body '{}', particle {}: position is {} cells from the origin; it must be finite and "
                    "within {:.3g} cells (an unstable step scatters particles: reduce the step)",
                    body.name, body.particles.identity[particle], x, limit));
  return cell_of(x);
}

}  // namespace

void Grid::rebuild(const std::vector<Body>& bodies) {
  body_count_ = bodies.size();
  blocks_.clear();
  find_.clear();
  sort_particles(bodies);
  add_neighbours();
  mark_constraints();
  for (std::vector<double>& field : fields_) field.resize(blocks_.size() * block_nodes);
  tile_data_.resize(tile_block_.size());
}

bool Grid::has_left(std::size_t tile, const std::vector<Body>& bodies) const {
  const Block& block = blocks_[static_cast<std::size_t>(tile_block_[tile])];
  const CellRange cells(block, 1.0 / cell_);
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    const auto& x = bodies[n].particles.position;
    const double *x0 = x[0].data(), *x1 = x[1].data();
    const Range range = particles(tile, n);
    int outside = 0;
    if (range.contiguous && range.begin != range.end) {
      const std::size_t first = *range.begin, end = first + static_cast<std::size_t>(range.end - range.begin);
#pragma omp simd reduction(| : outside)
      for (std::size_t i = first; i < end; ++i) outside |= cells.contain(x0[i], x1[i]) ? 0 : 1;
    } else {
      for (const std::uint32_t* k = range.begin; k != range.end; ++k)
        outside |= cells.contain(x0[*k], x1[*k]) ? 0 : 1;
    }
    if (outside != 0) return true;
  }
  return false;
}

/// Fills blocks_ (those with particles, by rising row and column), the lists of particles, and each block's
/// range of cells.
void Grid::sort_particles(const std::vector<Body>& bodies) {
  std::size_t total = 0;
  for (const Body& body : bodies) total += body.on_grid();
  home_.resize(total);
  index_.resize(total);

  constexpr std::int64_t lowest = std::numeric_limits<std::int64_t>::min(),
                         highest = std::numeric_limits<std::int64_t>::max();
  const double per_cell = 1.0 / cell_;
  std::size_t k = 0;
  std::int32_t last = -1;
  for (const Body& body : bodies)
    for (std::size_t p = 0; p < body.on_grid(); ++p, ++k) {
      const std::int64_t i = checked_cell(body.particles.position[0][p] * per_cell, body, p);
      const std::int64_t j = checked_cell(body.particles.position[1][p] * per_cell, body, p);
      const auto column = static_cast<std::int32_t>(block_of(i)),
                 row = static_cast<std::int32_t>(block_of(j));
      if (last < 0 || blocks_[static_cast<std::size_t>(last)].column != column ||
          blocks_[static_cast<std::size_t>(last)].row != row) {
        const auto [entry, added] =
            find_.try_emplace(key_of(column, row), static_cast<std::int32_t>(blocks_.size()));
        if (added) {
          blocks_.emplace_back();
          blocks_.back().column = column, blocks_.back().row = row;
          blocks_.back().cells = {highest, lowest, highest, lowest};
        }
        last = entry->second;
      }
      Block& block = blocks_[static_cast<std::size_t>(last)];
      block.cells = {std::min(block.cells[0], i), std::max(block.cells[1], i), std::min(block.cells[2], j),
                     std::max(block.cells[3], j)};
      home_[k] = last;
    }

  // Blocks in geometric order, so that sums over blocks do not depend on the order in which blocks were met.
  const std::size_t count = blocks_.size();
  std::vector<std::int32_t> order(count), rank(count);
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](std::int32_t a, std::int32_t b) {
    return before(blocks_[static_cast<std::size_t>(a)], blocks_[static_cast<std::size_t>(b)]);
  });
  std::vector<Block> sorted(count);
  tile_block_.resize(count);
  for (std::size_t n = 0; n < count; ++n) {
    sorted[n] = blocks_[static_cast<std::size_t>(order[n])];
    sorted[n].tile = static_cast<std::int32_t>(n);
    rank[static_cast<std::size_t>(order[n])] = static_cast<std::int32_t>(n);
    tile_block_[n] = static_cast<std::int32_t>(n);
    find_[key_of(sorted[n].column, sorted[n].row)] = static_cast<std::int32_t>(n);
    // Particles may move by up to a cell beyond where they are before the lists must be made anew.
    Block& b = sorted[n];
    const std::int64_t i0 = std::int64_t{b.column} * block_side, j0 = std::int64_t{b.row} * block_side;
    b.cells = {std::max(b.cells[0] - 1, i0), std::min(b.cells[1] + 1, i0 + block_side - 1),
               std::max(b.cells[2] - 1, j0), std::min(b.cells[3] + 1, j0 + block_side - 1)};
  }
  blocks_ = std::move(sorted);

  // Counting sort by (tile, body); within a list by identity, so that sums do not depend on the storage.
  offset_.assign(count * body_count_ + 1, 0);
  k = 0;
  for (std::size_t body = 0; body < body_count_; ++body)
    for (std::size_t p = 0; p < bodies[body].on_grid(); ++p, ++k) {
      home_[k] = rank[static_cast<std::size_t>(home_[k])];
      ++offset_[static_cast<std::size_t>(home_[k]) * body_count_ + body + 1];
    }
  std::partial_sum(offset_.begin(), offset_.end(), offset_.begin());
  std::vector<std::uint32_t> next(offset_.begin(), offset_.end() - 1);
  k = 0;
  for (std::size_t body = 0; body < body_count_; ++body)
    if (!bodies[body].coasting) k = append(bodies[body].particles, body, k, next);
  contiguous_.resize(count * body_count_);
  for (std::size_t list = 0; list < contiguous_.size(); ++list)
    contiguous_[list] = std::adjacent_find(index_.begin() + offset_[list], index_.begin() + offset_[list + 1],
                                           [](std::uint32_t a, std::uint32_t b) { return b != a + 1; }) ==
                        index_.begin() + offset_[list + 1];
}

/// Enters the particles of a body into their lists by rising identity. home: place of the body's first entry
/// in home_; returns that of the next body's.
std::size_t Grid::append(const Particles& p, std::size_t body, std::size_t home,
                         std::vector<std::uint32_t>& next) {
  const auto enter = [&](std::uint32_t particle) {
    const auto tile = static_cast<std::size_t>(home_[home + particle]);
    index_[next[tile * body_count_ + body]++] = particle;
  };
  const auto size = static_cast<std::uint32_t>(p.size);
  if (std::is_sorted(p.identity.begin(), p.identity.end())) {
    for (std::uint32_t i = 0; i < size; ++i) enter(i);
  } else {
    place_.resize(size);
    for (std::uint32_t i = 0; i < size; ++i) place_[p.identity[i]] = i;
    for (std::uint32_t identity = 0; identity < size; ++identity) enter(place_[identity]);
  }
  return home + size;
}

/// Adds the blocks whose nodes particles of other blocks may touch, and links all blocks.
void Grid::add_neighbours() {
  const bool wide = shape_ != ShapeKind::linear;
  const std::size_t with_particles = blocks_.size();
  for (std::size_t n = 0; n < with_particles; ++n) {
    const Block b = blocks_[n];
    const std::int64_t i0 = std::int64_t{b.column} * block_side, j0 = std::int64_t{b.row} * block_side;
    const std::int64_t last =
        block_side - (wide ? 2 : 1);  // from this cell on, the next block's nodes are touched
    const int left = wide && b.cells[0] == i0 && !(axisymmetric_ && b.column == 0) ? -1 : 0;
    const int right = b.cells[1] - i0 >= last ? 1 : 0;
    const int down = wide && b.cells[2] == j0 ? -1 : 0, up = b.cells[3] - j0 >= last ? 1 : 0;
    for (int dj = down; dj <= up; ++dj)
      for (int di = left; di <= right; ++di) {
        const auto [entry, added] =
            find_.try_emplace(key_of(b.column + di, b.row + dj), static_cast<std::int32_t>(blocks_.size()));
        if (added) {
          blocks_.emplace_back();
          blocks_.back().column = b.column + di, blocks_.back().row = b.row + dj;
        }
      }
  }
  // In geometric order too: what is summed over blocks must not depend on the particles that asked for them.
  std::sort(blocks_.begin() + static_cast<std::ptrdiff_t>(with_particles), blocks_.end(), before);
  for (std::size_t n = with_particles; n < blocks_.size(); ++n)
    find_[key_of(blocks_[n].column, blocks_[n].row)] = static_cast<std::int32_t>(n);
  for (Block& b : blocks_)
    for (int dj = -1; dj <= 1; ++dj)
      for (int di = -1; di <= 1; ++di) {
        const auto entry = find_.find(key_of(b.column + di, b.row + dj));
        b.neighbours[static_cast<std::size_t>(3 * (dj + 1) + di + 1)] =
            entry == find_.end() ? -1 : entry->second;
      }
}

/// Finds the held components of every node; of overlapping boundaries the later wins, the axis always.
void Grid::mark_constraints() {
  for (auto& c : constraints_) c.assign(blocks_.size() * block_nodes, Constraint::free);
  const double slack = 1e-9 * cell_;
  for (std::size_t n = 0; n < blocks_.size(); ++n) {
    Block& b = blocks_[n];
    b.constrained = false;
    const double side = block_side * cell_, r0 = b.column * side, z0 = b.row * side;
    const auto hold = [&](std::size_t component, int node, std::int16_t by) {
      constraints_[component][n * block_nodes + static_cast<std::size_t>(node)] = by;
      b.constrained = true;
    };
    for (std::size_t k = 0; k < boundaries_.size(); ++k) {
      const Boundary& wall = boundaries_[k];
      if (wall.min[0] > r0 + side || wall.max[0] < r0 - slack || wall.min[1] > z0 + side ||
          wall.max[1] < z0 - slack)
        continue;
      for (int node = 0; node < block_nodes; ++node) {
        const int i = node % block_side, j = node / block_side;
        const double r = r0 + i * cell_, z = z0 + j * cell_;
        if (r < wall.min[0] - slack || r > wall.max[0] + slack || z < wall.min[1] - slack ||
            z > wall.max[1] + slack)
          continue;
        for (std::size_t component = 0; component < 2; ++component)
          if (wall.fixed[component]) hold(component, node, static_cast<std::int16_t>(k));
      }
    }
    if (axisymmetric_ && b.column == 0)
      for (int j = 0; j < block_side; ++j) hold(0, j * block_side, Constraint::axis);
  }
}

}  // namespace vitrum::mpm
