#pragma once
#include "mpm/between_centroids.hpp"
#include "mpm/chunk_stress.hpp"
#include "mpm/pack.hpp"
#include "mpm/stencil.hpp"

namespace vitrum::mpm {

/// What a particle gives to a node, as vectors (momentum and / or force): share N + r h dN/dr + z h dN/dz.
template <int width>
struct Contribution {
  Pack<width> share, r, z;
};

/// What the particles of a chunk give to nodes. P: a plan of scatter.cpp: whether momenta and forces are
/// asked for, and how wide both are.
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

}  // namespace vitrum::mpm
