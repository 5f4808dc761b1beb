#pragma once
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "mpm/system.hpp"
#include "mpm/tile.hpp"

/// The nodes of single particles, for matrices.
namespace vitrum::mpm {

/// What one node of a particle's stencil contributes.
struct StencilNode {
  std::int64_t node;
  int column, row;                 ///< in the particle's block
  double value, slope_r, slope_z;  ///< N, dN/dr, dN/dz
  std::array<double, 2> parity;    ///< of the components: -1 across a plane whose image this was
};

/// Replaces an image by the node that it is the image of.
inline void take_node_of_image(std::span<const Image> images, const Block& block, StencilNode& s) {
  std::uint8_t entry = tile_entry(s.column, s.row);
  for (const Image& image : images)
    if (image.entry == entry) entry = image.node, s.parity[image.component] *= -1.0;
  s.column = entry % tile_columns - 1, s.row = entry / tile_columns - 1;
  s.node = node_at(block, s.column, s.row);
}

/// Calls f(body, particle, stencil) for all particles, tile by tile.
template <ShapeKind kind, class F>
void for_stencils(const System& system, F&& f) {
  using S = Shape1<kind>;
  const Grid& grid = system.grid;
  const double per_cell = 1.0 / grid.cell();
  std::array<StencilNode, static_cast<std::size_t>(S::count * S::count)> stencil{};
  for (std::size_t tile = 0; tile < grid.tiles().size(); ++tile) {
    const Block& block = grid.blocks()[static_cast<std::size_t>(grid.tiles()[tile])];
    const std::span<const Image> images = grid.images(tile);
    for (std::size_t n = 0; n < system.bodies.size(); ++n) {
      const Body& body = system.bodies[n];
      const Grid::Range range = grid.particles(tile, n);
      for (const std::uint32_t* k = range.begin; k != range.end; ++k) {
        const auto wr = S::at(body.particles.position[0][*k] * per_cell, body.half(0, *k) * per_cell),
                   wz = S::at(body.particles.position[1][*k] * per_cell, body.half(1, *k) * per_cell);
        std::size_t count = 0;
        for (std::size_t b = 0; b < S::count; ++b)
          for (std::size_t a = 0; a < S::count; ++a) {
            const auto i =
                static_cast<int>(wr.first - std::int64_t{block.column} * block_side) + static_cast<int>(a);
            const auto j =
                static_cast<int>(wz.first - std::int64_t{block.row} * block_side) + static_cast<int>(b);
            StencilNode& s = stencil[count++];
            s = {node_at(block, i, j),
                 i,
                 j,
                 wr.value[a] * wz.value[b],
                 per_cell * wr.slope[a] * wz.value[b],
                 per_cell * wr.value[a] * wz.slope[b],
                 {1.0, 1.0}};
            if (!images.empty()) take_node_of_image(images, block, s);
          }
        f(n, std::size_t{*k}, stencil);
      }
    }
  }
}

/// Neighbours of a node that share a particle with it are told by their offset in [-neighbour_reach,
/// neighbour_reach]^2.
inline constexpr int neighbour_reach = 3, neighbour_width = 2 * neighbour_reach + 1,
                     neighbour_offsets = neighbour_width * neighbour_width;

template <class From, class To>
std::size_t offset_between(const From& a, const To& b) {
  return static_cast<std::size_t>((b.row - a.row + neighbour_reach) * neighbour_width + b.column - a.column +
                                  neighbour_reach);
}

}  // namespace vitrum::mpm
