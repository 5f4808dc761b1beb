#include "mpm/reactions.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>

#include "mpm/tile.hpp"

namespace vitrum::mpm {
namespace {

/// Mass, force and acceleration of nodes as they are summed.
class Nodes {
 public:
  explicit Nodes(const System& system)
      : grid_(system.grid),
        gravity_(system.gravity),
        mass_(grid_.field(Field::mass)),
        force_{grid_.field(Field::force_0), grid_.field(Field::force_1)} {}

  /// What would move a node if nothing held it, N.
  double pull(std::size_t component, std::size_t node) const {
    return force_[component][node] + mass_[node] * gravity_[component];
  }
  /// What holds a node, N.
  double reaction(std::size_t component, std::size_t node, std::int16_t by) const {
    const double a = grid_.boundaries()[static_cast<std::size_t>(by)].acceleration[component];
    return mass_[node] * a - pull(component, node);
  }
  double acceleration(std::size_t component, std::size_t node) const {
    if (const std::int16_t by = grid_.constraint(component, node); by >= 0)
      return grid_.boundaries()[static_cast<std::size_t>(by)].acceleration[component];
    const bool moves = grid_.constraint(component, node) == Constraint::free &&
                       mass_[node] > std::numeric_limits<double>::min();
    return moves ? pull(component, node) / mass_[node] : 0.0;
  }

 private:
  const Grid& grid_;
  std::array<double, 2> gravity_;
  const double* mass_;
  std::array<const double*, 2> force_;
};

void add_held(const Grid& grid, const Nodes& nodes, double* forces) {
  for (std::size_t block = 0; block < grid.blocks().size(); ++block) {
    if (!grid.blocks()[block].constrained) continue;
    for (std::size_t c = 0; c < 2; ++c)
      for (std::size_t n = block * block_nodes; n < (block + 1) * block_nodes; ++n)
        if (const std::int16_t by = grid.constraint(c, n); by >= 0)
          forces[2 * static_cast<std::size_t>(by) + c] += nodes.reaction(c, n, by);
  }
}

/// The accelerations of the nodes and the images of a tile.
void add_images(const Grid& grid, std::size_t tile, const Nodes& nodes, double* forces) {
  const std::span<const Image> images = grid.images(tile);
  const std::span<const ImageSums> sums = grid.image_sums(tile);
  const Block& block = grid.blocks()[static_cast<std::size_t>(grid.tiles()[tile])];
  std::array<double, 2> acceleration[tile_nodes];
  bool is_image[tile_nodes] = {};
  for (const Image& image : images) is_image[image.entry] = true;
  for (std::size_t k = images.size(); k-- > 0;) {  // an image may be that of an image
    const Image& image = images[k];
    if (!is_image[image.node]) {
      const std::int64_t n = node_at(block, image.node % tile_columns - 1, image.node / tile_columns - 1);
      for (std::size_t c = 0; c < 2; ++c)
        acceleration[image.node][c] = n < 0 ? 0.0 : nodes.acceleration(c, static_cast<std::size_t>(n));
    }
    for (std::size_t c = 0; c < 2; ++c)
      acceleration[image.entry][c] = parity(c, image.component) * acceleration[image.node][c];
    if (image.by >= 0)
      forces[2 * static_cast<std::size_t>(image.by) + image.component] -=
          2.0 * (sums[k].force + sums[k].mass * acceleration[image.node][image.component]);
  }
}

}  // namespace

std::size_t reaction_count(const System& system) {
  return 2 * system.grid.boundaries().size();
}

void add_reactions(const System& system, double* forces) {
  const Grid& grid = system.grid;
  const Nodes nodes(system);
  add_held(grid, nodes, forces);
  for (std::size_t tile = 0; tile < grid.tiles().size(); ++tile)
    if (!grid.image_sums(tile).empty()) add_images(grid, tile, nodes, forces);
}

void ReactionIntegrals::begin(double* integrals) {
  std::ranges::fill(committed_, 0.0);
  std::fill_n(integrals, size(), 0.0);
}

void ReactionIntegrals::rates(const System& system, double* rates) const {
  std::fill_n(rates, size(), 0.0);
  if (size() > 0) add_reactions(system, rates);
}

void ReactionIntegrals::commit(System& system, const double* integrals) {
  for (std::size_t k = 0; k < size(); ++k)
    system.record.impulses[k] += integrals[k] - std::exchange(committed_[k], integrals[k]);
}

void book_reactions(System& system, double duration) {
  if (reaction_count(system) == 0) return;
  std::vector<double> forces(reaction_count(system));
  add_reactions(system, forces.data());
  for (std::size_t k = 0; k < forces.size(); ++k) system.record.impulses[k] += duration * forces[k];
}

}  // namespace vitrum::mpm
