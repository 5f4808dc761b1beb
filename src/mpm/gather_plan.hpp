#pragma once
#include "mpm/axis.hpp"
#include "mpm/between_centroids.hpp"
#include "mpm/chunk.hpp"
#include "mpm/pack.hpp"
#include "mpm/tile.hpp"
#include "mpm/transfer.hpp"

/// What the passes from nodes to particles need of the nodes, settled at compile time, and how it is brought
/// to the particles.
namespace vitrum::mpm {

/// What a node offers, as one pack: first the vector whose gradient or change is wanted, then the one that
/// moves particles (for rates: the acceleration).
enum class First { velocity, change };

template <Gather what>
struct Plan {
  static constexpr bool strain =
      what == Gather::strain || what == Gather::strain_and_position || what == Gather::all_from_new;
  static constexpr bool velocity = what == Gather::velocity || what == Gather::velocity_and_position ||
                                   what == Gather::all_from_new || what == Gather::velocity_and_rescatter;
  static constexpr bool rescatter = what == Gather::velocity_and_rescatter;
  static constexpr bool position = what == Gather::position || what == Gather::velocity_and_position ||
                                   what == Gather::all_from_new || what == Gather::strain_and_position;
  static constexpr bool rates = false, gradient = strain;
  static constexpr First first = velocity ? First::change : First::velocity;
  static constexpr int width = position ? 4 : 2;
  static constexpr int gradient_of =
      what == Gather::all_from_new ? 2 : 0;  ///< place of the vector in the pack
};

/// Plans of the passes that leave the particles as they are.
struct RatesPlan {
  static constexpr bool strain = false, velocity = false, rescatter = false, position = false, rates = true,
                        gradient = true;
  static constexpr First first = First::velocity;
  static constexpr int width = 4, gradient_of = 0;
};
struct GradientPlan {
  static constexpr bool strain = false, velocity = false, rescatter = false, position = false, rates = false,
                        gradient = true;
  static constexpr First first = First::velocity;
  static constexpr int width = 2, gradient_of = 0;
};

/// The nodes of a tile as one plan sees them.
template <ShapeKind kind, class P>
class NodePacks {
 public:
  NodePacks(const Grid& grid, std::size_t tile) {
    const double *v0 = grid.field(Field::velocity_0), *v1 = grid.field(Field::velocity_1),
                 *w0 = grid.field(Field::new_velocity_0), *w1 = grid.field(Field::new_velocity_1);
    load_tile<kind>(
        grid.blocks()[static_cast<std::size_t>(grid.tiles()[tile])],
        [&](std::size_t n, Pack<P::width>& node) {
          Pack<2> first{v0[n], v1[n]};
          const Pack<2> last{w0[n], w1[n]};
          if constexpr (P::first == First::change) first = last - first;
          if constexpr (P::width == 4)
            node = Pack<4>{first[0], first[1], last[0], last[1]};
          else
            node = first;
        },
        nodes_);
    if constexpr (kind != ShapeKind::linear) fill_images(grid.images(tile), nodes_);
  }
  const Pack<P::width>& operator[](std::size_t entry) const { return nodes_[entry]; }

 private:
  Pack<P::width> nodes_[tile_nodes];
};

/// Nodal packs interpolated at the particles of a chunk, and (plans with a gradient) their h d/dr and h d/dz.
template <class P>
class Interpolated {
 public:
  Interpolated() {}  // filled, not cleared
  template <class Stencils, class Nodes>
  void gather(const Stencils& at, std::size_t size, const Nodes& nodes) {
    for (std::size_t k = 0; k < size; ++k) {
      Pack<P::width> value{}, r{}, z{};
      for (std::size_t b = 0; b < at.count; ++b)
        for (std::size_t a = 0; a < at.count; ++a) {
          const Pack<P::width>& node = nodes[at.entry(k) + b * tile_columns + a];
          value += at.value(0, a, k) * at.value(1, b, k) * node;
          if constexpr (P::gradient) {
            r += at.slope(0, a, k) * at.value(1, b, k) * node;
            z += at.value(0, a, k) * at.slope(1, b, k) * node;
          }
        }
      value_[k] = value;
      if constexpr (P::gradient) r_[k] = r, z_[k] = z;
    }
  }

  /// Makes the plan's gradient one between centroids, for plans with a gradient.
  void take_between_centroids(const Chunk& chunk, const Particles& p) {
    const ColumnReader rr(chunk, p.centroids[0]), rz(chunk, p.centroids[1]), zr(chunk, p.centroids[2]),
        zz(chunk, p.centroids[3]);
    const double *h0 = rr.data(), *h1 = rz.data(), *h2 = zr.data(), *h3 = zz.data();
    double *r = reinterpret_cast<double*>(r_) + P::gradient_of,
           *z = reinterpret_cast<double*>(z_) + P::gradient_of;
    const std::size_t size = chunk.size();
#pragma GCC ivdep
    for (std::size_t k = 0; k < size; ++k) {
      const std::size_t n = P::width * k;
      const auto l =
          BetweenCentroids({h0[k], h1[k], h2[k], h3[k]}).gradient({r[n], z[n], r[n + 1], z[n + 1]});
      r[n] = l[0], z[n] = l[1], r[n + 1] = l[2], z[n + 1] = l[3];
    }
  }

  /// Adds to what moves the particles (plans that do, m/s) their last spin increment's turn about the
  /// interpolated centroids, which is what the interpolated velocities are of.
  void turn_about_centroids(const Chunk& chunk, const Particles& p, double duration) {
    const ColumnReader from_r(chunk, p.from_centroids[0]), from_z(chunk, p.from_centroids[1]),
        spin(chunk, p.spin_increment);
    double* velocity = reinterpret_cast<double*>(value_) + P::width - 2;
    for (std::size_t k = 0; k < chunk.size(); ++k) {
      const Rotation turn = rotation_by(spin[k]);
      velocity[P::width * k] += ((turn.cosine - 1.0) * from_r[k] - turn.sine * from_z[k]) / duration;
      velocity[P::width * k + 1] += (turn.sine * from_r[k] + (turn.cosine - 1.0) * from_z[k]) / duration;
    }
  }
  /// Spin of the k-th particle, rad/s, for plans with a gradient.
  double spin(std::size_t k, double cell) const {
    return 0.5 * (along_r()[P::width * k + 1] - along_z()[P::width * k]) / cell;
  }

  /// Component `place` of the k-th pack is at [width k + place].
  const double* values() const {
    return reinterpret_cast<const double*>(value_);
  }
  /// The same for the plan's gradient: h d/dr and h d/dz of a vector's components 0 and 1; and the vector
  /// itself.
  const double* along_r() const {
    return reinterpret_cast<const double*>(r_) + P::gradient_of;
  }
  const double* along_z() const {
    return reinterpret_cast<const double*>(z_) + P::gradient_of;
  }
  const double* differentiated() const {
    return values() + P::gradient_of;
  }

 private:
  Pack<P::width> value_[Chunk::capacity];
  Pack<P::width> r_[P::gradient ? Chunk::capacity : 1], z_[P::gradient ? Chunk::capacity : 1];
};

}  // namespace vitrum::mpm
