#include <algorithm>
#include <array>
#include <stdexcept>

#include "mpm/pass.hpp"
#include "mpm/system.hpp"

namespace vitrum::mpm {
namespace {

/// How many strips a thread has the tile data of at once. One of several: as many as may lie in its cache
/// beside particles and nodes, and at least some for others to help with.
std::size_t strips_at_once(const System& system, std::size_t stages) {
  constexpr std::size_t bytes = 512 * 1024, to_help_with = 2;
  const std::size_t fewest = parallel::Wave::fewest_at_once(stages);
  if (system.team->size() == 1) return fewest;
  const std::size_t tiles = std::max<std::size_t>(system.grid.strips().most_tiles_in(1), 1);
  return std::max(fewest + to_help_with, bytes / (tiles * sizeof(TileData)));
}

}  // namespace

void sweep(System& system, std::span<const Pass> passes) {
  struct Stage {
    const Pass* pass;
    bool of_blocks;
  };
  std::array<Stage, parallel::Wave::most_stages> stages{};
  std::size_t count = 0;
  for (const Pass& pass : passes) {
    if (count + 2 > stages.size()) throw std::logic_error("a sweep has at most four passes");
    stages[count++] = {&pass, false};
    if (pass.block != nullptr) stages[count++] = {&pass, true};
  }
  const parallel::Strips& strips = system.grid.strips();
  const auto particles_before = [&](std::size_t n) {
    return n == strips.pieces.size() ? system.grid.listed()
                                     : system.grid.listed_before(strips.pieces[n].first_tile);
  };
  system.grid.share_tiles(system.wave.share_out(*system.team, strips.first_pieces, particles_before));
  const std::size_t at_once = strips_at_once(system, count);
  if (count != passes.size()) system.grid.provide_tile_data(at_once);  // some pass adds up tiles for blocks
  auto take = [&](std::size_t stage, std::size_t n) {
    const auto [pass, of_blocks] = stages[stage];
    const parallel::Strips::Piece& piece = strips.pieces[n];
    if (of_blocks)
      piece.for_blocks([pass](std::size_t block) { pass->block(*pass, block); });
    else
      piece.for_tiles([pass](std::size_t tile) { pass->tile(*pass, tile); });
  };
  system.wave.run(*system.team, strips.first_pieces, count, at_once, take);
  for (const Pass& pass : passes)
    if (pass.finish != nullptr) pass.finish(pass);
}

}  // namespace vitrum::mpm
