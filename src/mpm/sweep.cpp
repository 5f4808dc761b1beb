#include <array>
#include <stdexcept>

#include "mpm/pass.hpp"
#include "mpm/system.hpp"

namespace vitrum::mpm {

void sweep(System& system, std::span<const Pass> passes) {
  struct Stage {
    const Pass* pass;
    bool of_blocks;
  };
  std::array<Stage, Wave::most_stages> stages{};
  std::size_t count = 0;
  for (const Pass& pass : passes) {
    if (count + 2 > stages.size()) throw std::logic_error("a sweep has at most four passes");
    stages[count++] = {&pass, false};
    if (pass.block != nullptr) stages[count++] = {&pass, true};
  }
  // One thread is done with a strip's tile data once the wave's end has passed it.
  const Strips& strips = system.grid.strips();
  system.grid.provide_tile_data(system.team->size() == 1 ? count + 1 : 0);
  const auto particles_before = [&](std::size_t n) {
    return n == strips.pieces.size() ? system.grid.listed()
                                     : system.grid.listed_before(strips.pieces[n].first_tile);
  };
  auto take = [&](std::size_t stage, std::size_t n) {
    const auto [pass, of_blocks] = stages[stage];
    const Strips::Piece& piece = strips.pieces[n];
    if (of_blocks)
      piece.for_blocks([pass](std::size_t block) { pass->block(*pass, block); });
    else
      piece.for_tiles([pass](std::size_t tile) { pass->tile(*pass, tile); });
  };
  system.wave.run(*system.team, strips.first_pieces, count, particles_before, take);
  system.grid.share_tiles(system.wave.shares());
  for (const Pass& pass : passes)
    if (pass.finish != nullptr) pass.finish(pass);
}

}  // namespace vitrum::mpm
