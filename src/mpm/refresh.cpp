#include <cstddef>
#include <utility>

#include "mpm/transfer.hpp"

namespace vitrum::mpm {

void refresh_grid(System& system, Storage storage) {
  Grid& grid = system.grid;
  const bool anew = std::exchange(system.grid_is_stale, true);  // should the lists throw
  if (anew)
    grid.rebuild(system.bodies);
  else if (grid.some_left())
    grid.relist(system.bodies, *system.team);
  // Sorting costs about a third of what scattered particles cost in a step, if all were. Lists made anew come
  // with storage that does not depend on the history either.
  if (storage == Storage::sorted) system.scattered_since_sorted += grid.scattered();
  if (storage == Storage::sorted && (anew || 3 * system.scattered_since_sorted >= grid.listed())) {
    // Then all particles may have to move, and one thread needs no copies of those that come from elsewhere.
    grid.sort_storage(system.bodies, *system.team, anew ? 1 : static_cast<std::size_t>(system.team->size()));
    system.scattered_since_sorted = 0;
  }
  system.grid_is_stale = false;
}

void refresh_grid_for_positions(System& system) {
  Grid& grid = system.grid;
  if (!system.grid_is_stale)
    system.team->for_each_chunk(grid.tiles().size(), [&](std::size_t tile) {
      grid.note_moved(tile, system.bodies, grid.has_left(tile, system.bodies));
    });
  refresh_grid(system);
}

}  // namespace vitrum::mpm
