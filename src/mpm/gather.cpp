#include "mpm/axis.hpp"
#include "mpm/tile.hpp"
#include "mpm/transfer.hpp"

namespace vitrum::mpm {
namespace {

// Slots of a local tile: the velocity for the strain, the velocity that moves particles (for rates: the
// acceleration), the velocity's change.
constexpr std::size_t strain_slot = 0, motion_slot = 2, change_slot = 4;
// Slots of the grid's own tile in which MUSL sums the second momenta.
constexpr std::size_t momentum_slot = 1;

/// What the particles of a tile contribute to the record of the step.
struct TileSums {
  double kinetic = 0.0;
  bool stale = false;
};

template <Gather what>
struct Plan {
  static constexpr bool strain =
      what == Gather::strain || what == Gather::strain_and_position || what == Gather::all_from_new;
  static constexpr bool strain_from_new = what == Gather::all_from_new;
  static constexpr bool velocity = what == Gather::velocity || what == Gather::velocity_and_position ||
                                   what == Gather::all_from_new || what == Gather::velocity_and_rescatter;
  static constexpr bool rescatter = what == Gather::velocity_and_rescatter;
  static constexpr bool position = what == Gather::position || what == Gather::velocity_and_position ||
                                   what == Gather::all_from_new || what == Gather::strain_and_position;
  static constexpr bool rates = false, gradient = false;
};

/// Plans of the passes that leave the particles as they are.
struct RatesPlan {
  static constexpr bool strain = false, strain_from_new = false, velocity = false, rescatter = false,
                        position = false, rates = true, gradient = true;
};
struct GradientPlan {
  static constexpr bool strain = false, strain_from_new = false, velocity = false, rescatter = false,
                        position = false, rates = false, gradient = true;
};

struct TileReader {
  const Block& block;
  bool at_axis;

  void load(const double* field, double* tile, double parity) const {
    load_tile(block, field, tile);
    if (at_axis) mirror_axis(tile, parity);
  }
};

void store(const ParticleGradient& to, std::size_t i, double rr, double rz, double zr, double zz, double tt) {
  to.gradient[0][i] = rr, to.gradient[1][i] = rz, to.gradient[2][i] = zr, to.gradient[3][i] = zz;
  to.gradient[4][i] = tt;
}
void store(const ParticleRates& to, std::size_t i, double rr, double rz, double zr, double zz, double tt) {
  const SymmetricTensor e = rotate({rr, zz, tt, 0.5 * (rz + zr)}, rotation_by(-to.turn[i]));
  to.strain[0][i] = e.rr, to.strain[1][i] = e.zz, to.strain[2][i] = e.tt, to.strain[3][i] = e.rz;
  to.spin[i] = 0.5 * (zr - rz);
}

/// P: a plan. targets: by body, for the plans that have a target; otherwise null.
template <ShapeKind kind, bool axisymmetric, class P, class Target>
TileSums gather_tile(System& system, std::size_t tile, double duration,
                     [[maybe_unused]] const Target* targets) {
  using S = Shape1<kind>;
  Grid& grid = system.grid;
  const Block& block = grid.blocks()[static_cast<std::size_t>(grid.tiles()[tile])];
  const TileReader reader{block, axisymmetric && kind != ShapeKind::linear && block.column == 0};
  alignas(64) double local[6][tile_nodes];
  double *s0 = local[strain_slot], *s1 = local[strain_slot + 1];  // strain
  double *m0 = local[motion_slot], *m1 = local[motion_slot + 1];  // new velocity: motion
  double *d0 = local[change_slot], *d1 = local[change_slot + 1];  // new minus old
  if constexpr (P::velocity || P::position || P::rates) {
    reader.load(grid.field(Field::new_velocity_0), m0, -1.0);
    reader.load(grid.field(Field::new_velocity_1), m1, 1.0);
  }
  if constexpr (P::velocity || P::gradient || (P::strain && !P::strain_from_new)) {
    reader.load(grid.field(Field::velocity_0), s0, -1.0);
    reader.load(grid.field(Field::velocity_1), s1, 1.0);
  }
  if constexpr (P::velocity)
    for (std::size_t n = 0; n < tile_nodes; ++n) d0[n] = m0[n] - s0[n], d1[n] = m1[n] - s1[n];
  if constexpr (P::strain_from_new) s0 = m0, s1 = m1;
  double *p0 = grid.tile_data(tile) + momentum_slot * tile_nodes, *p1 = p0 + tile_nodes;
  if constexpr (P::rescatter) std::fill(p0, p0 + 2 * tile_nodes, 0.0);

  TileSums sums;
  const CellRange range(block);
  const double per_cell = 1.0 / grid.cell();
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    const auto [begin, end] = grid.particles(tile, n);
    if (begin == end) continue;
    Body& body = system.bodies[n];
    Particles& p = body.particles;
    const double half = body.particle_half_size * per_cell;
    for (const std::uint32_t* k = begin; k != end; ++k) {
      const std::size_t i = *k;
      const double r = p.position[0][i], z = p.position[1][i];
      const auto wr = S::at(r * per_cell, half), wz = S::at(z * per_cell, half);
      const std::size_t entry = tile_entry(block, wr, wz);
      double rr = 0.0, rz = 0.0, zr = 0.0, zz = 0.0, vr = 0.0, dv0 = 0.0, dv1 = 0.0, dx0 = 0.0, dx1 = 0.0;
      for (std::size_t b = 0; b < S::count; ++b)
        for (std::size_t a = 0; a < S::count; ++a) {
          const std::size_t node = entry + b * tile_columns + a;
          const double N = wr.value[a] * wz.value[b];
          if constexpr (P::strain || P::gradient) {
            const double Nr = wr.slope[a] * wz.value[b], Nz = wr.value[a] * wz.slope[b];
            rr += Nr * s0[node];
            rz += Nz * s0[node];
            zr += Nr * s1[node];
            zz += Nz * s1[node];
            if constexpr (axisymmetric) vr += N * s0[node];
          }
          if constexpr (P::velocity) dv0 += N * d0[node], dv1 += N * d1[node];
          if constexpr (P::position) dx0 += N * m0[node], dx1 += N * m1[node];
          if constexpr (P::rates) {
            dx0 += N * s0[node], dx1 += N * s1[node];
            dv0 += N * m0[node], dv1 += N * m1[node];
          }
        }
      if constexpr (P::gradient)
        store(targets[n], i, per_cell * rr, per_cell * rz, per_cell * zr, per_cell * zz,
              axisymmetric ? vr / hoop_radius(r, grid.cell()) : 0.0);
      if constexpr (P::rates) {
        targets[n].position[0][i] = dx0, targets[n].position[1][i] = dx1;
        targets[n].velocity[0][i] = dv0, targets[n].velocity[1][i] = dv1;
      }
      if constexpr (P::strain) {
        const double scale = duration * per_cell;
        const double hoop = axisymmetric ? duration * vr / hoop_radius(r, grid.cell()) : 0.0;
        const double spin = 0.5 * scale * (zr - rz);
        // The integral of R^T D R over the increment, R turning from 0 to `spin`.
        const SymmetricTensor e =
            rotate({scale * rr, scale * zz, hoop, 0.5 * scale * (rz + zr)}, rotation_by(-0.5 * spin));
        p.strain_increment[0][i] = e.rr, p.strain_increment[1][i] = e.zz;
        p.strain_increment[2][i] = e.tt, p.strain_increment[3][i] = e.rz;
        p.spin_increment[i] = spin;
      }
      if constexpr (P::velocity) {
        const double v0 = p.velocity[0][i] += dv0, v1 = p.velocity[1][i] += dv1;
        sums.kinetic += 0.5 * p.mass[i] * (v0 * v0 + v1 * v1);
      }
      if constexpr (P::rescatter) {
        const double mv0 = p.mass[i] * p.velocity[0][i], mv1 = p.mass[i] * p.velocity[1][i];
        for (std::size_t b = 0; b < S::count; ++b)
          for (std::size_t a = 0; a < S::count; ++a) {
            const double N = wr.value[a] * wz.value[b];
            p0[entry + b * tile_columns + a] += N * mv0;
            p1[entry + b * tile_columns + a] += N * mv1;
          }
      }
      if constexpr (P::position) {
        double x0 = r + duration * dx0;
        const double x1 = z + duration * dx1;
        if (axisymmetric && x0 < 0.0) x0 = -x0, reflect_at_axis(p, i);
        p.position[0][i] = x0, p.position[1][i] = x1;
        sums.stale |= !range.contains(x0 * per_cell, x1 * per_cell);
      }
    }
  }
  if constexpr (P::rescatter && axisymmetric && kind != ShapeKind::linear)
    if (block.column == 0) fold_axis(p0, -1.0), fold_axis(p1, 1.0);
  return sums;
}

template <class P, class Target>
void gather_all(System& system, double duration, const Target* targets) {
  Grid& grid = system.grid;
  static thread_local std::vector<TileSums> of_tile;  // of the calling thread; workers write to its elements
  std::vector<TileSums>& sums = of_tile;
  sums.resize(grid.tiles().size());
  dispatch(grid, [&]<ShapeKind kind, bool axisymmetric>() {
    system.team->for_each_chunk(grid.tiles().size(), [&](std::size_t tile) {
      sums[tile] = gather_tile<kind, axisymmetric, P>(system, tile, duration, targets);
    });
  });
  if constexpr (P::velocity) {
    system.record.kinetic = 0.0;
    for (const TileSums& s : sums) system.record.kinetic += s.kinetic;
  }
  if constexpr (P::position)
    for (const TileSums& s : sums) system.grid_is_stale |= s.stale;
  if constexpr (P::rescatter)
    system.team->for_each_chunk(grid.blocks().size(), [&](std::size_t n) {
      reduce_tiles(grid, grid.blocks()[n], n, momentum_slot, Field::momentum_0);
      reduce_tiles(grid, grid.blocks()[n], n, momentum_slot + 1, Field::momentum_1);
    });
}

}  // namespace

void gather(System& system, Gather what, double duration) {
  const auto all = [&]<Gather w>() { gather_all<Plan<w>, void>(system, duration, nullptr); };
  switch (what) {
    case Gather::strain:
      return all.template operator()<Gather::strain>();
    case Gather::velocity:
      return all.template operator()<Gather::velocity>();
    case Gather::position:
      return all.template operator()<Gather::position>();
    case Gather::velocity_and_position:
      return all.template operator()<Gather::velocity_and_position>();
    case Gather::all_from_new:
      return all.template operator()<Gather::all_from_new>();
    case Gather::velocity_and_rescatter:
      return all.template operator()<Gather::velocity_and_rescatter>();
    case Gather::strain_and_position:
      return all.template operator()<Gather::strain_and_position>();
  }
}

void gather_rates(System& system, std::span<const ParticleRates> rates) {
  gather_all<RatesPlan>(system, 1.0, rates.data());
}

void gather_gradient(System& system, std::span<const ParticleGradient> gradients) {
  gather_all<GradientPlan>(system, 1.0, gradients.data());
}

double kinetic_energy(const System& system) {
  double sum = 0.0;
  for (const Body& body : system.bodies)
    for (std::size_t i = 0; i < body.particles.size; ++i) {
      const double v0 = body.particles.velocity[0][i], v1 = body.particles.velocity[1][i];
      sum += 0.5 * body.particles.mass[i] * (v0 * v0 + v1 * v1);
    }
  return sum;
}

}  // namespace vitrum::mpm
