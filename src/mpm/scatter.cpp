#include <array>
#include <numeric>
#include <utility>

#include "mpm/between_centroids.hpp"
#include "mpm/loads.hpp"
#include "mpm/nodes.hpp"
#include "mpm/stencil.hpp"
#include "mpm/transfer.hpp"

namespace vitrum::mpm {
namespace {

template <Scatter what>
struct Plan {
  static constexpr bool momentum = what != Scatter::force, force = what != Scatter::momentum;
  static constexpr int width = momentum && force ? 4 : 2;
};

/// What a particle gives to a node, as vectors (momentum and / or force): share N + r h dN/dr + z h dN/dz.
template <int width>
struct Contribution {
  Pack<width> share, r, z;
};

/// The stress of a chunk that internal forces are made of: that of a state that is tried, or the law's.
class ChunkStress {
 public:
  ChunkStress(const Chunk& chunk, const Body& body) {
    const Particles& p = body.particles;
    const auto& tried = p.tried_stress;
    if (tried[0].empty()) {
      follow(chunk, p, *body.material);
      return;
    }
    for (std::size_t c = 0; c < 4; ++c) columns_[c] = read(chunk, tried[c], values_[c]);
    columns_[4] = read(chunk, p.tried_stress_zr.empty() ? tried[3] : p.tried_stress_zr, values_[4]);
  }
  ChunkStress(const ChunkStress&) = delete;
  ChunkStress& operator=(const ChunkStress&) = delete;

  const double* rr() const { return columns_[0]; }
  const double* zz() const { return columns_[1]; }
  const double* tt() const { return columns_[2]; }
  const double* rz() const { return columns_[3]; }
  const double* zr() const { return columns_[4]; }

 private:
  void follow(const Chunk& chunk, const Particles& p, const Material& material) {
    const auto& e = p.elastic_strain;
    const ColumnReader e0(chunk, e[0]), e1(chunk, e[1]), e2(chunk, e[2]), e3(chunk, e[3]);
    VariableColumns<const double*> variables;
    variables.resize(p.variables.size());
    double copies[most_columns][Chunk::capacity];
    for (const std::size_t c : material.stress_columns())
      variables[c] = read(chunk, p.variables[c], copies[c]);
    material.stress({e0.data(), e1.data(), e2.data(), e3.data()}, variables, chunk.size(),
                    {values_[0], values_[1], values_[2], values_[3]});
    for (std::size_t c = 0; c < 5; ++c) columns_[c] = values_[std::min<std::size_t>(c, 3)];
  }
  /// The column itself where the particles lie one behind the other, else a copy.
  static const double* read(const Chunk& chunk, const std::vector<double>& column, double* copy) {
    if (chunk.contiguous()) return column.data() + chunk.place(0);
    for (std::size_t k = 0; k < chunk.size(); ++k) copy[k] = column[chunk.place(k)];
    return copy;
  }

  const double* columns_[5];
  double values_[5][Chunk::capacity];
};

template <bool axisymmetric, class P>
class Contributions {
 public:
  /// The masses of the chunk's particles, and what they give to nodes.
  void gather(const Chunk& chunk, const Body& body, double cell, const ColumnReader& radius) {
    const Particles& p = body.particles;
    const ColumnReader mass(chunk, p.mass), v0(chunk, p.velocity[0]), v1(chunk, p.velocity[1]);
    const double per_cell = 1.0 / cell, specific_volume = 1.0 / body.material->density();
    double* to = values_[0];
    const std::size_t size = chunk.size();
    const double* m = mass.data();
    if constexpr (P::force) {
      const ChunkStress s(chunk, body);
      const double *rr = s.rr(), *zz = s.zz(), *tt = s.tt(), *rz = s.rz(), *zr = s.zr(), *r = radius.data();
      constexpr std::size_t first = P::momentum ? 2 : 0, width = P::width;
#pragma GCC ivdep
      for (std::size_t k = 0; k < size; ++k) {
        double* share = to + 3 * width * k + first;
        const double volume = m[k] * specific_volume, pull = -volume * per_cell;
        share[0] = axisymmetric ? -volume * tt[k] / hoop_radius(r[k], cell) : 0.0, share[1] = 0.0;
        share[width] = pull * rr[k], share[width + 1] = pull * zr[k];
        share[2 * width] = pull * rz[k], share[2 * width + 1] = pull * zz[k];
      }
      if (!p.contact_force[0].empty()) add_contact(chunk, p, per_cell);
      if (!p.centroids[0].empty()) act_between_centroids(chunk, p);
    }
    if constexpr (P::momentum) {
      const double *from0 = v0.data(), *from1 = v1.data();
#pragma GCC ivdep
      for (std::size_t k = 0; k < size; ++k) {
        mass_[k] = m[k];
        to[3 * P::width * k] = m[k] * from0[k], to[3 * P::width * k + 1] = m[k] * from1[k];
      }
    }
  }

  double mass(std::size_t k) const {
    return mass_[k];
  }
  const Contribution<P::width>& operator[](std::size_t k) const {
    return *reinterpret_cast<const Contribution<P::width>*>(values_[k]);
  }

 private:
  /// A couple acts on the spin (dv_z/dr - dv_r/dz) / 2, as stress acts on strain rates.
  void add_contact(const Chunk& chunk, const Particles& p, double per_cell) {
    constexpr std::size_t first = P::momentum ? 2 : 0, width = P::width;
    for (std::size_t k = 0; k < chunk.size(); ++k) {
      const std::size_t i = chunk.place(k);
      double* share = values_[k] + first;
      share[0] += p.contact_force[0][i], share[1] += p.contact_force[1][i];
      double couple = p.contact_force[2][i];
      if (!p.centroids[0].empty())  // the particle moves as fixed to the interpolated centroids
        couple +=
            p.from_centroids[0][i] * p.contact_force[1][i] - p.from_centroids[1][i] * p.contact_force[0][i];
      const double twist = 0.5 * per_cell * couple;
      share[width + 1] += twist, share[2 * width] -= twist;
    }
  }

  /// Forces whose power on the nodes' velocities is that of stress on the gradient between centroids.
  void act_between_centroids(const Chunk& chunk, const Particles& p) {
    const ColumnReader rr(chunk, p.centroids[0]), rz(chunk, p.centroids[1]), zr(chunk, p.centroids[2]),
        zz(chunk, p.centroids[3]);
    constexpr std::size_t width = P::width;
    for (std::size_t k = 0; k < chunk.size(); ++k) {
      double *r = values_[k] + width + (P::momentum ? 2 : 0), *z = r + width;
      const auto q = BetweenCentroids({rr[k], rz[k], zr[k], zz[k]}).stress({r[0], z[0], r[1], z[1]});
      r[0] = q[0], z[0] = q[1], r[1] = q[2], z[1] = q[3];
    }
  }

  alignas(64) double mass_[Chunk::capacity];
  alignas(64) double values_[Chunk::capacity][3 * P::width]{};  // momentum has no part in r and z: 0 stays
};

template <ShapeKind kind, bool axisymmetric, class P>
void scatter_tile(System& system, std::size_t tile) {
  Grid& grid = system.grid;
  const Block& block = grid.blocks()[static_cast<std::size_t>(grid.tiles()[tile])];
  TileData& data = grid.tile_data(tile);
  Pack<P::width>* vectors = data.template packs<P::width>();
  double* masses = data.mass;
  clear_tile<kind>(vectors);
  if constexpr (P::momentum) clear_tile<kind>(masses);

  const double per_cell = 1.0 / grid.cell();
  Contributions<axisymmetric, P> gives;
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    const Body& body = system.bodies[n];
    for_chunks(grid, tile, n, [&](const Chunk& chunk) {
      const ColumnReader r(chunk, body.particles.position[0]), z(chunk, body.particles.position[1]);
      const Stencils<kind> at(chunk, block, per_cell, body, r, z);
      gives.gather(chunk, body, grid.cell(), r);
      for (std::size_t k = 0; k < chunk.size(); ++k) {
        const Contribution<P::width>& c = gives[k];
        for (std::size_t b = 0; b < at.count; ++b)
          for (std::size_t a = 0; a < at.count; ++a) {
            const std::size_t node = at.entry(k) + b * tile_columns + a;
            const double N = at.value(0, a, k) * at.value(1, b, k);
            Pack<P::width> sum = vectors[node] + N * c.share;
            if constexpr (P::force) {
              sum += at.slope(0, a, k) * at.value(1, b, k) * c.r;
              sum += at.value(0, a, k) * at.slope(1, b, k) * c.z;
            }
            vectors[node] = sum;
            if constexpr (P::momentum) masses[node] += N * gives.mass(k);
          }
      }
    });
  }
  if constexpr (kind != ShapeKind::linear) {
    const std::span<const Image> images = grid.images(tile);
    const std::span<ImageSums> sums = grid.image_sums(tile);
    fold_images(images, vectors, [&](std::size_t n, const Pack<P::width>& from) {
      if constexpr (P::force)
        if (!sums.empty()) sums[n].force = from[P::width - 2 + images[n].component];
    });
    if constexpr (P::momentum)
      fold_images(images, masses, [&](std::size_t n, double from) {
        if (!sums.empty()) sums[n].mass = from;
      });
  }
}

/// Adds up what the tiles hold for the nodes of a block: their masses, and their vectors by component.
template <ShapeKind kind, class P>
void sum_block(Grid& grid, std::size_t index, const std::array<double*, P::width>& to) {
  Pack<P::width> vectors[block_nodes]{};
  double mass[block_nodes]{};
  for_shares<kind>(grid, grid.blocks()[index],
                   [&](const TileData& tile, std::size_t entry, std::size_t node) {
                     vectors[node] += tile.template packs<P::width>()[entry];
                     if constexpr (P::momentum) mass[node] += tile.mass[entry];
                   });
  if constexpr (P::momentum)
    std::copy(mass, mass + block_nodes, grid.field(Field::mass) + index * block_nodes);
  for (std::size_t c = 0; c < P::width; ++c)
    for (int node = 0; node < block_nodes; ++node) to[c][node] = vectors[node][c];
}

/// The sums of a block, to be kept.
template <ShapeKind kind, class P>
void store_sums(const Pass& pass, std::size_t block) {
  constexpr auto first = static_cast<std::size_t>(P::momentum ? Field::momentum_0 : Field::force_0);
  std::array<double*, P::width> to{};
  for (std::size_t c = 0; c < P::width; ++c)
    to[c] = pass.system->grid.field(static_cast<Field>(first + c)) + block * block_nodes;
  sum_block<kind, P>(pass.system->grid, block, to);
}

/// The sums of a block are made velocities at once, and new velocities if it has forces.
template <ShapeKind kind, class P>
void move_block(const Pass& pass, std::size_t block) {
  System& system = *pass.system;
  Grid& grid = system.grid;
  alignas(64) double sums[P::width][block_nodes];
  std::array<double*, P::width> to{};
  for (std::size_t c = 0; c < P::width; ++c) to[c] = sums[c];
  sum_block<kind, P>(grid, block, to);
  if constexpr (P::momentum) {
    project_block(grid, block, {sums[0], sums[1]});
    if (grid.keeps_sums() && grid.blocks()[block].constrained)
      for (std::size_t c = 0; c < 2; ++c)
        std::copy_n(sums[c], block_nodes,
                    grid.field(c == 0 ? Field::momentum_0 : Field::momentum_1) + block * block_nodes);
  }
  if constexpr (P::force) {
    const BlockVector force{sums[P::width - 2], sums[P::width - 1]};
    accelerate_block(grid, block, force, system.gravity, pass.duration);
    if (grid.keeps_forces(block))
      for (std::size_t c = 0; c < 2; ++c)
        std::copy_n(force[c], block_nodes,
                    grid.field(c == 0 ? Field::force_0 : Field::force_1) + block * block_nodes);
    if (pass.parts != nullptr)
      (*pass.parts)[block] = external_power(system, block, force, Field::velocity_0, Field::new_velocity_0);
  }
}

void book_external_work(const Pass& pass) {
  const std::size_t blocks = pass.system->grid.blocks().size();
  pass.system->record.external_work +=
      pass.duration *
      std::accumulate(pass.parts->begin(), pass.parts->begin() + static_cast<std::ptrdiff_t>(blocks), 0.0);
}

template <Scatter what>
Pass pass_of(System& system, Nodes until) {
  using P = Plan<what>;
  Pass pass;
  dispatch(system.grid, [&]<ShapeKind kind, bool axisymmetric>() {
    pass.tile = [](const Pass& own, std::size_t tile) {
      scatter_tile<kind, axisymmetric, P>(*own.system, tile);
    };
    pass.block = until == Nodes::sums ? store_sums<kind, P> : move_block<kind, P>;
  });
  // What a boundary that changes speed does depends on the momenta that it meets (external_power).
  if (until == Nodes::sums || drives(system)) system.grid.keep_sums();
  return pass;
}

}  // namespace

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

Pass scatter_pass(System& system, Scatter what, Nodes until, double duration) {
  Pass pass;
  switch (what) {
    case Scatter::momentum:
      pass = pass_of<Scatter::momentum>(system, until);
      break;
    case Scatter::force:
      pass = pass_of<Scatter::force>(system, until);
      break;
    case Scatter::momentum_and_force:
      pass = pass_of<Scatter::momentum_and_force>(system, until);
      break;
  }
  pass.system = &system, pass.duration = duration;
  if (until == Nodes::moved && what != Scatter::momentum && has_external_work(system)) {
    static thread_local std::vector<double> power_of_block;  // of the calling thread; workers write to it
    power_of_block.resize(system.grid.blocks().size());
    pass.parts = &power_of_block;
    pass.finish = book_external_work;
  }
  return pass;
}

void scatter(System& system, Scatter what, Nodes until, double duration) {
  sweep(system, {{scatter_pass(system, what, until, duration)}});
}

}  // namespace vitrum::mpm
