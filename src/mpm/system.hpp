#pragma once
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "integrators/local/local_integrator.hpp"
#include "mpm/grid.hpp"
#include "mpm/particles.hpp"
#include "parallel/thread_team.hpp"
#include "parallel/wave.hpp"

namespace vitrum {

/// An event of the last step.
struct BodyEvent {
  std::size_t body, particle;
  Event event;
};

/// A particle that has left the computation, as it was then.
struct RemovedParticle {
  std::size_t body;
  std::uint32_t identity;
  double mass;                            ///< kg (per radian or per metre)
  std::array<double, 2> place, velocity;  ///< m, m/s
};

/// What the last step did, summed over all bodies in a fixed order. Joules per radian (axisymmetric) or per
/// metre.
struct StepRecord {
  double kinetic = 0.0;               ///< at the end of the step
  double elastic = 0.0;               ///< stored, at the end of the step
  Dissipation dissipated;             ///< in the step
  double contact = 0.0;               ///< stored between bodies, at the end of the step
  double friction = 0.0;              ///< dissipated between bodies in the step
  double filtered = 0.0;              ///< removed by the filters of pressures and velocities in the step
  double removed = 0.0;               ///< went with particles that left in the step
  double external_work = 0.0;         ///< of gravity, tractions and prescribed velocities in the step
  std::vector<BodyEvent> events;      ///< in order of time, body and identity
  std::vector<RemovedParticle> left;  ///< in the step, in order of body and identity
  /// Impulse of each boundary on the bodies, two components each, since the record was last read: who reads
  /// sets it back. N s (per radian or per metre).
  std::vector<double> impulses;
  bool particles_moved = true;  ///< they stand where the time is: not so within a Lagrangian phase
};

namespace mpm {
class Contact;
class Tractions;
}  // namespace mpm

/// All that moves: bodies, their grid, and how their particles' local equations are integrated.
struct System {
  bool axisymmetric = true;
  double cell = 0.0;               ///< m
  bool between_centroids = false;  ///< gradients are taken between centroids, not between nodes
  bool filters = false;            ///< pressures that nodes do not see are removed (mpm/filter.hpp)
  double flip = 1.0;               ///< share of velocities that nodes do not see that stays in a step
  std::vector<Body> bodies;
  std::array<double, 2> gravity{0.0, 0.0};  ///< m/s^2, at present (mpm/loads.hpp)
  std::array<std::shared_ptr<const mpm::LoadFunction>, 2> gravity_over_time{};  ///< null: constant
  mpm::Grid grid;
  std::unique_ptr<LocalIntegrator> local;
  std::unique_ptr<parallel::ThreadTeam> team;
  parallel::Wave wave;                        ///< how the team goes over the grid
  std::shared_ptr<mpm::Contact> contact;      ///< null: bodies share one velocity field
  std::shared_ptr<mpm::Tractions> tractions;  ///< null: there are none

  double time = 0.0;  ///< s
  std::int64_t step_index = 0;
  StepRecord record;
  std::int64_t constitutive_evaluations = 0, constitutive_events = 0;
  SolverCounters constitutive_solver;      ///< work of the local ODE solvers so far
  bool coasting_settled = false;           ///< it has been decided which bodies start coasting
  bool grid_is_stale = true;               ///< the grid's lists of particles are void
  std::size_t scattered_since_sorted = 0;  ///< particles out of order in memory, summed over steps

  std::size_t particle_count() const {
    std::size_t n = 0;
    for (const Body& body : bodies) n += body.particles.size;
    return n;
  }
};

}  // namespace vitrum
