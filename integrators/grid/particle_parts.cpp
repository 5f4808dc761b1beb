// How the unknowns of the particle system are divided among threads.
#include <algorithm>

#include "integrators/grid/particle_system.hpp"

namespace vitrum {

/// Puts the parts in the order of the tiles that they lie in, so that threads have much the same particles
/// here as on the grid (there shares follow the threads' speeds, and may change).
void ParticleSystem::order_parts() {
  const mpm::Grid& grid = system_.grid;
  std::vector<std::vector<std::size_t>> tiles(
      system_.bodies.size());  // by body and part: of its first particle
  for (std::size_t n = 0; n < tiles.size(); ++n)
    tiles[n].assign(system_.bodies[n].particles.size / most_in_part + 1, 0);
  for (std::size_t tile = 0; tile < grid.tiles().size(); ++tile)
    for (std::size_t n = 0; n < tiles.size(); ++n) {
      const mpm::Grid::Range range = grid.particles(tile, n);
      for (const std::uint32_t* i = range.begin; i < range.end; ++i)
        if (*i % most_in_part == 0) tiles[n][*i / most_in_part] = tile;
    }
  const auto place_of = [&](const Part& part) {
    return std::array{tiles[part.body][part.begin / most_in_part], part.body, part.begin};
  };
  std::sort(parts_.begin(), parts_.end(),
            [&](const Part& a, const Part& b) { return place_of(a) < place_of(b); });
}

void ParticleSystem::for_ranges(RangeTask task, void* context) const {
  for_each_part([&](const Part& part, std::size_t k) {
    for (std::size_t a = 0; a < arrays(); ++a) {
      const std::size_t first = place(part.body, a);
      task(context, k, first + part.begin, first + part.end);
    }
    if (tail_ < size_ && k + 1 == parts_.size()) task(context, k, tail_, size_);
  });
}

}  // namespace vitrum
