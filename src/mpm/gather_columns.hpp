#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "mpm/axis.hpp"
#include "mpm/domain.hpp"
#include "mpm/gather_plan.hpp"
#include "mpm/stencil.hpp"
#include "mpm/stress_update.hpp"
#include "mpm/transfer.hpp"

// What a chunk of particles takes from what has been interpolated at them: strain, velocity, position and
// their rates go to its columns.

namespace vitrum::mpm {

/// Largest absolute value.
inline double largest_size(const double* values, std::size_t size) {
  double largest = 0.0;
#pragma omp simd reduction(max : largest)
  for (std::size_t k = 0; k < size; ++k) largest = std::max(largest, std::abs(values[k]));
  return largest;
}

/// Strain increments of a chunk: R^T D R at the middle of the increment, R turning from 0 to `spin`.
template <bool axisymmetric, bool small, class P>
void store_turned(std::size_t size, const Interpolated<P>& at, const double* spin, const double* radius,
                  double cell, double duration, const TensorPointers<double>& to) {
  const double *r = at.along_r(), *z = at.along_z(), *v = at.differentiated();
  double *e0 = to[0], *e1 = to[1], *e2 = to[2], *e3 = to[3];
  const double scale = duration / cell;
#pragma GCC ivdep
  for (std::size_t k = 0; k < size; ++k) {
    const std::size_t n = P::width * k;
    const double hoop = axisymmetric ? duration * v[n] / hoop_radius(radius[k], cell) : 0.0;
    const Rotation turn = small ? rotation_by_small(-0.5 * spin[k]) : rotation_by(-0.5 * spin[k]);
    const SymmetricTensor e =
        rotate({scale * r[n], scale * z[n + 1], hoop, 0.5 * scale * (z[n] + r[n + 1])}, turn);
    e0[k] = e.rr, e1[k] = e.zz, e2[k] = e.tt, e3[k] = e.rz;
  }
}

/// Strain and spin increments of a chunk over `duration`.
template <bool axisymmetric, class P>
void interpolate_strain(std::size_t size, const Interpolated<P>& at, const ColumnReader& radius, double cell,
                        double duration, const TensorPointers<double>& to, double* spin) {
  const double *r = at.along_r(), *z = at.along_z();
  const double half_scale = 0.5 * duration / cell;
#pragma GCC ivdep
  for (std::size_t k = 0; k < size; ++k) spin[k] = half_scale * (r[P::width * k + 1] - z[P::width * k]);
  if (0.5 * largest_size(spin, size) <= small_angle)
    store_turned<axisymmetric, true>(size, at, spin, radius.data(), cell, duration, to);
  else
    store_turned<axisymmetric, false>(size, at, spin, radius.data(), cell, duration, to);
}

template <bool axisymmetric, class P>
void store_strain(const Chunk& chunk, Particles& p, const Interpolated<P>& at, const ColumnReader& radius,
                  double cell, double duration) {
  ColumnWriter e0(chunk, p.strain_increment[0]), e1(chunk, p.strain_increment[1]),
      e2(chunk, p.strain_increment[2]), e3(chunk, p.strain_increment[3]), spin(chunk, p.spin_increment);
  interpolate_strain<axisymmetric>(chunk.size(), at, radius, cell, duration,
                                   {e0.data(), e1.data(), e2.data(), e3.data()}, spin.data());
}

/// The same without a detour through memory that no one else will read.
template <bool axisymmetric, class P>
void strain_and_stress(const Chunk& chunk, Body& owner, std::size_t tile, std::size_t body,
                       StressUpdate& stress, const Interpolated<P>& at, const ColumnReader& radius,
                       double cell, double duration) {
  Particles& p = owner.particles;
  ChunkIncrements increments;
  auto& e = increments.strain;
  interpolate_strain<axisymmetric>(chunk.size(), at, radius, cell, duration, {e[0], e[1], e[2], e[3]},
                                   increments.spin);
  stress.take(tile, body, chunk, increments);
  if (!p.turn.empty())
    for (std::size_t k = 0; k < chunk.size(); ++k) p.turn[chunk.place(k)] += increments.spin[k];
  if (have_domains(p)) {
    const std::vector<double>& length = owner.column("effective_length");
    for (std::size_t k = 0; k < chunk.size(); ++k)
      add_stretch(p, length, chunk.place(k), {e[0][k], e[1][k], e[2][k], e[3][k]}, increments.spin[k]);
  }
  if (!p.centroids[0].empty()) {
    ColumnWriter spin(chunk, p.spin_increment);
    std::copy_n(increments.spin, chunk.size(), spin.data());
  }
}

/// Adds the interpolated change to the velocities; returns the kinetic energy of the chunk then.
template <class P>
double store_velocity(const Chunk& chunk, Particles& p, const Interpolated<P>& at) {
  const ColumnReader old0(chunk, p.velocity[0]), old1(chunk, p.velocity[1]), masses(chunk, p.mass);
  ColumnWriter new0(chunk, p.velocity[0]), new1(chunk, p.velocity[1]);
  const double *from0 = old0.data(), *from1 = old1.data(), *mass = masses.data(), *change = at.values();
  double *to0 = new0.data(), *to1 = new1.data(), kinetic = 0.0;
  const std::size_t size = chunk.size();
#pragma omp simd reduction(+ : kinetic)
  for (std::size_t k = 0; k < size; ++k) {
    const double v0 = from0[k] + change[P::width * k], v1 = from1[k] + change[P::width * k + 1];
    to0[k] = v0, to1[k] = v1;
    kinetic += 0.5 * mass[k] * (v0 * v0 + v1 * v1);
  }
  return kinetic;
}

/// Moves the particles of a chunk. Whether some particle leaves the cells that its block was made for.
template <bool axisymmetric, class P>
bool store_position(const Chunk& chunk, Particles& p, const Interpolated<P>& at, const ColumnReader& r,
                    const ColumnReader& z, const CellRange& block_cells, double duration) {
  ColumnWriter new0(chunk, p.position[0]), new1(chunk, p.position[1]);
  const double *from0 = r.data(), *from1 = z.data(), *v = at.values() + P::width - 2;
  double *to0 = new0.data(), *to1 = new1.data();
  double moved[Chunk::capacity];  // where the axis is no obstacle
  const CellRange cells = block_cells;
  const std::size_t size = chunk.size();
  int beyond = 0, left = 0;
#pragma omp simd reduction(| : beyond, left)
  for (std::size_t k = 0; k < size; ++k) {
    const double x0 = from0[k] + duration * v[P::width * k], x1 = from1[k] + duration * v[P::width * k + 1];
    moved[k] = x0;
    to0[k] = axisymmetric ? std::abs(x0) : x0, to1[k] = x1;
    beyond |= x0 < 0.0 ? 1 : 0;
    left |= cells.contain(axisymmetric ? std::abs(x0) : x0, x1) ? 0 : 1;
  }
  if (axisymmetric && beyond != 0)
    for (std::size_t k = 0; k < size; ++k)
      if (moved[k] < 0.0) reflect_at_axis(p, chunk.place(k));
  return left != 0;
}

/// Gradients of a chunk (1/s), in the axes of space or, for rates, in those that have turned with the
/// particle.
template <bool axisymmetric, class P>
void store_gradient(const Chunk& chunk, const ParticleGradient& to, const Interpolated<P>& at,
                    const ColumnReader& radius, double cell) {
  ColumnWriter rr(chunk, to.gradient[0]), rz(chunk, to.gradient[1]), zr(chunk, to.gradient[2]),
      zz(chunk, to.gradient[3]), tt(chunk, to.gradient[4]);
  const double *r = at.along_r(), *z = at.along_z(), *v = at.differentiated(), per_cell = 1.0 / cell;
  for (std::size_t k = 0; k < chunk.size(); ++k) {
    const std::size_t n = P::width * k;
    rr[k] = per_cell * r[n], rz[k] = per_cell * z[n], zr[k] = per_cell * r[n + 1],
    zz[k] = per_cell * z[n + 1];
    tt[k] = axisymmetric ? v[n] / hoop_radius(radius[k], cell) : 0.0;
  }
  for (std::size_t c = 0; c < 2 && to.value[c] != nullptr; ++c)
    for (std::size_t k = 0; k < chunk.size(); ++k) to.value[c][chunk.place(k)] = v[P::width * k + c];
}

template <bool axisymmetric, bool small, class P>
void store_turned_rates(std::size_t size, const Interpolated<P>& at, const double* turn, const double* radius,
                        double cell, const TensorPointers<double>& to, double* spin) {
  const double *r = at.along_r(), *z = at.along_z(), *v = at.differentiated(), per_cell = 1.0 / cell;
  double *e0 = to[0], *e1 = to[1], *e2 = to[2], *e3 = to[3];
#pragma GCC ivdep
  for (std::size_t k = 0; k < size; ++k) {
    const std::size_t n = P::width * k;
    const double hoop = axisymmetric ? v[n] / hoop_radius(radius[k], cell) : 0.0;
    const SymmetricTensor e =
        rotate({per_cell * r[n], per_cell * z[n + 1], hoop, 0.5 * per_cell * (z[n] + r[n + 1])},
               small ? rotation_by_small(-turn[k]) : rotation_by(-turn[k]));
    e0[k] = e.rr, e1[k] = e.zz, e2[k] = e.tt, e3[k] = e.rz;
    spin[k] = 0.5 * per_cell * (r[n + 1] - z[n]);
  }
}

template <bool axisymmetric, class P>
void store_gradient(const Chunk& chunk, const ParticleRates& to, const Interpolated<P>& at,
                    const ColumnReader& radius, double cell) {
  ColumnWriter rr(chunk, to.strain[0]), zz(chunk, to.strain[1]), tt(chunk, to.strain[2]),
      rz(chunk, to.strain[3]), spin(chunk, to.spin);
  const ColumnReader turns(chunk, to.turn);
  const double *turn = turns.data(), largest = largest_size(turn, chunk.size());
  const TensorPointers<double> strain{rr.data(), zz.data(), tt.data(), rz.data()};
  if (largest <= small_angle)
    store_turned_rates<axisymmetric, true>(chunk.size(), at, turn, radius.data(), cell, strain, spin.data());
  else
    store_turned_rates<axisymmetric, false>(chunk.size(), at, turn, radius.data(), cell, strain, spin.data());
}

}  // namespace vitrum::mpm
