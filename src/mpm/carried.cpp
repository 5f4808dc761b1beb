#include "mpm/carried.hpp"

#include <cmath>

#include "mpm/reactions.hpp"
#include "mpm/stencil.hpp"

namespace vitrum::mpm {
namespace {

/// What a node's velocity component is held at, and by which boundary.
struct Held {
  bool held;
  double velocity;  ///< m/s
  std::int16_t by;
  bool driven;  ///< the velocity varies
};

/// One component of the nodes of a tile.
template <ShapeKind kind>
class HeldNodes {
 public:
  HeldNodes(const Grid& grid, std::size_t tile, std::size_t component) {
    load_tile<kind>(
        grid.blocks()[static_cast<std::size_t>(grid.tiles()[tile])],
        [&](std::size_t n, Held& node) {
          const std::int16_t by = grid.constraint(component, n);
          const Boundary* wall = by >= 0 ? &grid.boundaries()[static_cast<std::size_t>(by)] : nullptr;
          node = {by != Constraint::free, wall != nullptr ? wall->velocity[component] : 0.0, by,
                  wall != nullptr && wall->drive[component] != nullptr};
        },
        nodes_);
    const std::span<const Image> images = grid.images(tile);
    for (std::size_t k = images.size(); k-- > 0;) {
      const Held& of = nodes_[images[k].node];
      nodes_[images[k].entry] = {of.held, images[k].component == component ? -of.velocity : of.velocity,
                                 of.by, of.driven};
    }
  }
  const Held& operator[](std::size_t entry) const { return nodes_[entry]; }

 private:
  Held nodes_[tile_nodes];
};

/// The velocity of the k-th particle where all its nodes are held; `otherwise` where they are not.
template <ShapeKind kind>
double carried_velocity(const Stencils<kind>& at, std::size_t k, const HeldNodes<kind>& nodes,
                        double otherwise, double slack) {
  double sum = 0.0, first = 0.0;
  bool any = false, same = true, driven = false;
  for (std::size_t b = 0; b < at.count; ++b)
    for (std::size_t a = 0; a < at.count; ++a) {
      const double N = at.value(0, a, k) * at.value(1, b, k);
      if (N == 0.0) continue;
      const Held& node = nodes[at.entry(k) + b * tile_columns + a];
      if (!node.held) return otherwise;
      if (!any) first = node.velocity;
      any = true, same = same && node.velocity == first, driven = driven || node.driven;
      sum += N * node.velocity;
    }
  const double carried = same ? first : sum;  // sum N is 1 but for rounding, which would change at every step
  return driven && std::abs(carried - otherwise) <= slack ? otherwise : carried;
}

/// Gives the boundaries that hold the k-th particle's nodes their parts of an impulse on it.
template <ShapeKind kind>
void share_impulse(const Stencils<kind>& at, std::size_t k, const HeldNodes<kind>& nodes, double impulse,
                   std::size_t component, double* impulses) {
  for (std::size_t b = 0; b < at.count; ++b)
    for (std::size_t a = 0; a < at.count; ++a)
      if (const std::int16_t by = nodes[at.entry(k) + b * tile_columns + a].by; by >= 0)
        impulses[2 * static_cast<std::size_t>(by) + component] +=
            at.value(0, a, k) * at.value(1, b, k) * impulse;
}

/// impulses: by boundary, added to.
template <ShapeKind kind>
Carried carry_tile(System& system, std::size_t tile, double slack, double* impulses) {
  const Grid& grid = system.grid;
  const Block& block = grid.blocks()[static_cast<std::size_t>(grid.tiles()[tile])];
  const HeldNodes<kind> held[2] = {{grid, tile, 0}, {grid, tile, 1}};
  const double per_cell = 1.0 / grid.cell();
  Carried carried;
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    Body& body = system.bodies[n];
    Particles& p = body.particles;
    for_chunks(grid, tile, n, [&](const Chunk& chunk) {
      const ColumnReader r(chunk, p.position[0]), z(chunk, p.position[1]);
      const Stencils<kind> at(chunk, block, per_cell, body, r, z);
      for (std::size_t k = 0; k < chunk.size(); ++k)
        for (std::size_t c = 0; c < 2; ++c) {
          const std::size_t i = chunk.place(k);
          double& velocity = p.velocity[c][i];
          const double old = velocity;
          velocity = carried_velocity<kind>(at, k, held[c], old, slack);
          if (velocity == old) continue;
          carried.changed = true;
          carried.work += 0.5 * p.mass[i] * (velocity * velocity - old * old);
          share_impulse<kind>(at, k, held[c], p.mass[i] * (velocity - old), c, impulses);
        }
    });
  }
  return carried;
}

}  // namespace

Carried carry_held(System& system, double slack) {
  const std::size_t tiles = system.grid.tiles().size();
  bool some = false;
  for (std::size_t tile = 0; tile < tiles && !some; ++tile) some = system.grid.may_carry(tile);
  if (!some) return {};
  const std::size_t count = reaction_count(system);
  std::vector<Carried> parts(tiles);
  std::vector<double> impulses(tiles * count);
  dispatch(system.grid, [&]<ShapeKind kind, bool>() {
    system.team->for_each_chunk(tiles, [&](std::size_t tile) {
      if (system.grid.may_carry(tile))
        parts[tile] = carry_tile<kind>(system, tile, slack, impulses.data() + tile * count);
    });
  });
  Carried all;
  for (const Carried& part : parts) all.work += part.work, all.changed = all.changed || part.changed;
  for (std::size_t k = 0; all.changed && k < impulses.size(); ++k)
    system.record.impulses[k % count] += impulses[k];
  return all;
}

}  // namespace vitrum::mpm
