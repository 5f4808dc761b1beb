// Which velocity components of nodes the boundaries and the axis hold, and what follows from it for tiles.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "mpm/computation_error.hpp"
#include "mpm/grid.hpp"
#include "mpm/tile.hpp"

namespace vitrum::mpm {
namespace {

/// The part of some rows that lies in `count` of them from row `first` on, counted from there; empty where
/// its begin is not below its end.
struct Piece {
  int begin, end;
  Piece(const Rows& rows, double first, int count)
      : begin(static_cast<int>(std::clamp(rows.first - first, 0.0, static_cast<double>(count)))),
        end(static_cast<int>(std::clamp(rows.last - first + 1.0, 0.0, static_cast<double>(count)))) {}
};

double first_node(const Block& b, std::size_t component) {
  return static_cast<double>(component == 0 ? b.column : b.row) * block_side;
}

}  // namespace

Grid::Grid(double cell, ShapeKind shape, bool axisymmetric, std::vector<Boundary> boundaries)
    : cell_(cell), shape_(shape), axisymmetric_(axisymmetric), boundaries_(std::move(boundaries)) {
  shifts_.resize(boundaries_.size());
  by_priority_.resize(boundaries_.size());
  std::iota(by_priority_.begin(), by_priority_.end(), 0);
  std::stable_sort(by_priority_.begin(), by_priority_.end(), [&](std::int16_t a, std::int16_t b) {
    return boundaries_[static_cast<std::size_t>(a)].priority <
           boundaries_[static_cast<std::size_t>(b)].priority;
  });
}

void Grid::move_boundaries(double time) {
  bool any = false;
  for (std::size_t k = 0; k < boundaries_.size(); ++k)
    for (std::size_t c = 0; c < 2; ++c) {
      const double shift = boundaries_[k].shift(c, time, cell_);
      any = any || shift != shifts_[k][c];
      shifts_[k][c] = shift;
    }
  if (any) mark_constraints();
}

double Grid::next_boundary_shift(double time) const {
  double next = std::numeric_limits<double>::infinity();
  for (const Boundary& b : boundaries_) next = std::min(next, b.next_shift(time, cell_));
  return next;
}

Rows Grid::held_rows(std::size_t boundary, std::size_t component) const {
  return boundaries_[boundary].rows(component, shifts_[boundary][component], cell_);
}

/// Lets a boundary hold a component of a node, unless one of a higher priority does. (They come by rising
/// priority.)
void Grid::hold(std::size_t component, std::size_t node, std::int16_t by) {
  std::int16_t& holder = constraints_[component][node];
  if (holder >= 0) {
    const Boundary &a = boundaries_[static_cast<std::size_t>(holder)],
                   &b = boundaries_[static_cast<std::size_t>(by)];
    if (a.priority == b.priority && !a.drives_as(b, component))
      throw ComputationError(
          fmt::format("boundaries '{}' and '{}' have met: they hold the same nodes at different velocities "
                      "({:g} and {:g} m/s); give one of them a higher 'priority'",
                      a.name, b.name, a.velocity[component], b.velocity[component]));
  }
  holder = by;
}

void Grid::mark_constraints() {
  for (auto& c : constraints_) c.assign(blocks_.size() * block_nodes, Constraint::free);
  for (std::size_t n = 0; n < blocks_.size(); ++n) {
    Block& b = blocks_[n];
    b.constrained = false;
    for (const std::int16_t k : by_priority_) {
      const auto boundary = static_cast<std::size_t>(k);
      const Piece columns(held_rows(boundary, 0), first_node(b, 0), block_side),
          rows(held_rows(boundary, 1), first_node(b, 1), block_side);
      for (int j = rows.begin; j < rows.end; ++j)
        for (int i = columns.begin; i < columns.end; ++i)
          for (std::size_t c = 0; c < 2; ++c)
            if (boundaries_[boundary].fixed[c]) {
              hold(c, n * block_nodes + static_cast<std::size_t>(j * block_side + i), k);
              b.constrained = true;
            }
    }
    if (axisymmetric_ && b.column == 0)
      for (std::size_t j = 0; j < block_side; ++j) {
        constraints_[0][n * block_nodes + j * block_side] = Constraint::axis;
        b.constrained = true;
      }
  }
  list_images();
  find_carrying_tiles();
}

/// Lists the images of the nodes of each tile: first those beyond the axis, then by boundary. Linear
/// functions touch none.
void Grid::list_images() {
  images_.clear();
  first_image_.assign(tile_block_.size() + 1, 0);
  for (std::size_t tile = 0; shape_ != ShapeKind::linear && tile < tile_block_.size(); ++tile) {
    const Block& block = blocks_[static_cast<std::size_t>(tile_block_[tile])];
    if (axisymmetric_ && block.column == 0)
      for (int row = -1; row < tile_rows - 1; ++row)
        images_.push_back({tile_entry(-1, row), tile_entry(1, row), 0, Constraint::axis});
    for (std::size_t component = 0; component < 2; ++component)
      for (std::size_t k = 0; k < boundaries_.size(); ++k)
        if (boundaries_[k].mirrors && boundaries_[k].fixed[component]) {
          list_images_of(block, k, component, 1);
          list_images_of(block, k, component, -1);
        }
    first_image_[tile + 1] = images_.size();
  }
  mirrors_ = std::ranges::any_of(images_, [](const Image& image) { return image.by >= 0; });
  image_sums_.assign(mirrors_ ? images_.size() : 0, {});
}

/// Lists the images beyond the last (side 1) or the first (side -1) row of a plane of symmetry. They are free
/// along the plane as their nodes are: where a boundary lets them stick to it, it is none.
void Grid::list_images_of(const Block& block, std::size_t boundary, std::size_t component, int side) {
  const Rows across = held_rows(boundary, component), along = held_rows(boundary, 1 - component);
  constexpr double deep = 3.0;  // cells; then both faces may be planes
  if (!(across.last - across.first >= deep)) return;
  const double face = (side > 0 ? across.last : across.first) - first_node(block, component);
  if (!(face >= 0.0 && face <= block_side)) return;  // image or node is beyond the tile
  const auto plane = static_cast<int>(face);
  const auto node = [&](int normal, int tangential) {
    return component == 0 ? node_at(block, normal, tangential) : node_at(block, tangential, normal);
  };
  const auto entry = [&](int normal, int tangential) {
    return component == 0 ? tile_entry(normal, tangential) : tile_entry(tangential, normal);
  };
  const Piece tangentials(along, first_node(block, 1 - component) - 1.0, block_side + 3);
  const auto by = static_cast<std::int16_t>(boundary);
  for (int t = tangentials.begin - 1; t < tangentials.end - 1; ++t) {
    const std::int64_t on = node(plane, t), behind = node(plane - side, t), before = node(plane + side, t);
    if (on < 0 || behind < 0 || before < 0) continue;
    const auto held = [&](std::size_t c, std::int64_t n) {
      return constraints_[c][static_cast<std::size_t>(n)];
    };
    if (held(component, on) == by && held(component, behind) == by &&
        held(1 - component, behind) == held(1 - component, before))
      images_.push_back(
          {entry(plane - side, t), entry(plane + side, t), static_cast<std::uint8_t>(component), by});
  }
}

/// Finds the tiles with some cell whose nodes are all held in a component: only there particles can be
/// carried.
void Grid::find_carrying_tiles() {
  carries_.assign(tile_block_.size(), false);
  for (std::size_t tile = 0; !boundaries_.empty() && tile < tile_block_.size(); ++tile) {
    const Block& block = blocks_[static_cast<std::size_t>(tile_block_[tile])];
    if (!block.constrained) continue;
    for (std::size_t c = 0; c < 2 && !carries_[tile]; ++c) {
      const auto held = [&](int i, int j) {
        const std::int64_t n = node_at(block, i, j);
        return n >= 0 && constraints_[c][static_cast<std::size_t>(n)] != Constraint::free;
      };
      for (int j = 0; j < block_side && !carries_[tile]; ++j)
        for (int i = 0; i < block_side && !carries_[tile]; ++i)
          carries_[tile] = held(i, j) && held(i + 1, j) && held(i, j + 1) && held(i + 1, j + 1);
    }
  }
}

}  // namespace vitrum::mpm
