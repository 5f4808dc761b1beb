#pragma once
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

#include "mpm/contact/contact.hpp"
#include "mpm/load_function.hpp"
#include "mpm/transfer.hpp"

namespace vitrum::mpm {

/// A point of a quadrature over a loaded surface, and the particle that carries it: it moves and turns with
/// that particle.
struct LoadedPoint {
  std::uint32_t carrier;  ///< identity of the particle
  Vector offset;          ///< m, from the particle, at the start
  Vector place;           ///< m, at the start: where functions of place are evaluated
  double angle;           ///< rad, of the outward normal, counter-clockwise from r, at the start
  double area;            ///< m^2 (per radian) or m (per metre), at the start
};

/// A traction c^s on a part of a body's surface (eq. 3).
struct Traction {
  std::size_t body = 0;
  std::shared_ptr<const LoadFunction> pressure;               ///< Pa, against the outward normal; or
  std::array<std::shared_ptr<const LoadFunction>, 2> vector;  ///< Pa
  bool follows = false;  ///< pressure stays normal to the surface, which keeps its area
  std::vector<LoadedPoint> points;
};

/// Velocities of a body's particles as the grid moves them, by place, and their spin.
struct ParticleMotion {
  std::array<const double*, 2> velocity;  ///< m/s
  const double* spin;                     ///< rad/s
};

/// Tractions act on the particles next to the surface, in the boundary layer of eq. 3, as forces and couples
/// (Particles::contact_force): what nodes get adds up to the integral over the surface to rounding, and every
/// integrator takes them as it takes contact. A quadrature of the exact surface stands for the particles' V /
/// h.
class Tractions {
 public:
  /// Lets all bodies keep track of how particles turn.
  Tractions(System& system, std::vector<Traction> tractions);

  bool act_on(std::size_t body) const;
  /// Adds the forces at a time (s) to the particles'. bodies: the state that they are in.
  void load(System& system, double time, std::span<const Configuration> bodies);
  /// Power of the forces loaded last at the particles' motion, W (per radian or per metre).
  double power(std::span<const ParticleMotion> motion) const;
  /// Adds the work of an explicit step to the record: at the velocities in its middle, those before and half
  /// of what the particles' changes project to.
  void book_work(System& system, double duration);
  /// The derivative of a particle's force to its turn, N, by `key_of` body and place; empty where nothing
  /// follows.
  const std::unordered_map<std::uint64_t, Vector>& by_turn() const { return by_turn_; }

  double next_kink(double time) const;
  const std::vector<Traction>& list() const { return tractions_; }

 private:
  void find_carriers(const System& system);
  std::vector<ParticleGradient> interpolate(System& system);

  std::vector<Traction> tractions_;
  std::vector<std::vector<std::uint32_t>> place_;            // by traction and point: in the columns
  std::vector<std::array<std::vector<double>, 3>> force_;    // by body and particle: force and couple
  std::vector<std::array<std::vector<double>, 7>> motions_;  // by body: velocity, gradient
  std::unordered_map<std::uint64_t, Vector> by_turn_;
};

/// From the gradient of a body's motion: spins, and velocities of particles as fixed to the interpolated
/// centroids where gradients are taken between these.
void set_spins(const Particles& particles, const ParticleGradient& motion, std::vector<double>& spin);

}  // namespace vitrum::mpm
