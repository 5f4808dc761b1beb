#pragma once
#include <span>

#include "mpm/pass.hpp"
#include "mpm/stress_update.hpp"
#include "mpm/system.hpp"
#include "mpm/trial.hpp"

/// The operators between particles and grid, shared by every integrator of the momentum equations. Results do
/// not depend on the number of threads: each block sums its own particles by rising identity, and blocks are
/// combined in geometric order.
namespace vitrum::mpm {

/// Whether particles may change their places in memory: not while an integrator holds arrays of its own.
enum class Storage { kept, sorted };
/// Brings the lists of particles up to date when some particle has left the cells its block was made for.
void refresh_grid(System& system, Storage storage = Storage::kept);
/// The same for positions that no operator has moved (those of a trial).
void refresh_grid_for_positions(System& system);

enum class Scatter { momentum, force, momentum_and_force };
/// Particles to nodes: mass and momentum m_i = sum N m_p, p_i = sum N m_p v_p, and / or internal forces f_i
/// (N per radian or per metre; physics: f_r = -sum V (s_rr N,r + s_rz N,z + s_tt N/r), f_z = -sum V (s_rz N,r
/// + s_zz N,z), V = V0, the reference volume: docs/theory/strain-and-stress.md).
/// until: whether nodes keep their sums, or go on at once as by project_velocities and, with forces, to their
/// new velocities after `duration` seconds under these and gravity (held components keep their prescribed
/// ones). Momenta and forces then reach no memory, and the work of gravity and of prescribed velocities is
/// added to system.record.external_work.
enum class Nodes { sums, moved };
Pass scatter_pass(System& system, Scatter what, Nodes until = Nodes::sums, double duration = 0.0);
void scatter(System& system, Scatter what, Nodes until = Nodes::sums, double duration = 0.0);

/// Nodal velocities from mass and momentum; held components get their prescribed values.
void project_velocities(System& system);
/// Whether gravity or a prescribed velocity can do work.
bool has_external_work(const System& system);
/// Nodal accelerations a_i = f_i / m_i + g, 0 for held components. Returns the power of gravity and of
/// prescribed velocities at the nodal `velocity`, W (per radian or per metre).
double accelerate(System& system);

/// What a pass from nodes to particles does.
enum class Gather {
  strain,                  ///< strain and spin increments from `velocity`
  velocity,                ///< v += N (new - old)
  position,                ///< x += dt N new
  velocity_and_position,   ///< v += N (new - old), x += dt N new
  all_from_new,            ///< the two together, strain from `new_velocity` (USL)
  velocity_and_rescatter,  ///< v += N (new - old), nodal `velocity` from the particles' new momenta (MUSL)
  strain_and_position,     ///< strain from `velocity`, x += dt N `new_velocity` (MUSL)
};
/// stress: where the pass gathers strains, takes the particles over them while their data is at hand, as
/// update_stress would; to be booked afterwards.
Pass gather_pass(System& system, Gather what, double duration, StressUpdate* stress = nullptr);
void gather(System& system, Gather what, double duration);

/// Where the rates of one body's particles go: arrays of one entry a particle.
struct ParticleRates {
  std::array<double*, 2> position, velocity;  ///< m/s, m/s^2
  TensorPointers<double> strain;              ///< 1/s, in the frame that has turned by `turn`
  double* spin;                               ///< rad/s
  const double* turn;                         ///< rad, counter-clockwise from r to z, in
};
/// Rates of the particle system from nodal `velocity` and `acceleration`: x' = N v, v' = N a, e' = R^T D R
/// with R the rotation by `turn`, w' = the in-plane spin. rates: by body.
void gather_rates(System& system, std::span<const ParticleRates> rates);

/// Where the gradient of one body goes: (rr, rz, zr, zz, tt), dv_i/dx_j; tt is v_r / r.
struct ParticleGradient {
  std::array<double*, 5> gradient;
  std::array<double*, 2> value{};  ///< the velocity itself; null: not wanted
};
/// Gradient of the nodal `velocity` (or of what stands in its place) at every particle. gradients: by body.
void gather_gradient(System& system, std::span<const ParticleGradient> gradients);

/// Takes every particle's stress and state over the strain increments gathered before; fills the energies and
/// events of system.record.
void update_stress(System& system, double duration);
/// The same for a trial in place (Trial::Scope): stress and elastic strain of the state tried. The committed
/// state, its internal variables and the record stay as they are.
void try_stress(System& system, const Trial& trial, double duration);

/// Consistent tangents of the increments of a trial in place, by body and particle (Material::tangent).
void gather_tangents(System& system, const Trial& trial, double duration,
                     std::vector<std::vector<TangentEntries>>& tangents);

/// Kinetic energy of the particles now, J (per radian or per metre).
double kinetic_energy(const System& system);

}  // namespace vitrum::mpm
