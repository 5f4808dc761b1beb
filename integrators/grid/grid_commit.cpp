// What a phase leaves: the committed state after each step, and moved particles at its end.
#include <algorithm>
#include <cmath>
#include <utility>

#include "integrators/grid/grid_system.hpp"
#include "integrators/grid/particle_chunks.hpp"
#include "mpm/domain.hpp"
#include "mpm/loads.hpp"
#include "mpm/stress.hpp"

namespace vitrum {

using mpm::Field;
using mpm::FiniteStrain;

/// Held nodes whose velocity varies take their particles along at the end of the phase. What that takes, of
/// kinetic energy and of impulse, is booked here. q: by unknown. Returns the kinetic energy gained since the
/// start.
double GridSystem::book_driven(double t, const double* q) {
  if (!mpm::drives(system_)) return 0.0;
  set_loads(t);
  const mpm::OfBoundaries held = mpm::boundary_velocities(system_);
  mpm::OfBoundaries changes = held;
  for (std::size_t k = 0; k < held.size(); ++k)
    for (std::size_t c = 0; c < 2; ++c) changes[k][c] -= held_at_start_[k][c];
  const double* mass = system_.grid.field(Field::mass);
  for (std::size_t block = 0; block < system_.grid.blocks().size(); ++block) {
    if (!system_.grid.blocks()[block].constrained) continue;
    for (std::size_t n = block * mpm::block_nodes; n < (block + 1) * mpm::block_nodes; ++n)
      for (std::size_t c = 0; c < 2; ++c)
        if (const std::int16_t by = system_.grid.constraint(c, n); by >= 0) {
          const auto k = static_cast<std::size_t>(by);
          system_.record.impulses[2 * k + c] += mass[n] * (held[k][c] - held_committed_[k][c]);
        }
  }
  held_committed_ = held;
  const double gained = mass_.gain_by_boundaries(q, changes);
  system_.record.external_work += gained - std::exchange(driven_gain_, gained);
  return gained;
}

void GridSystem::commit(double t, const double* y) {
  const std::size_t n = nodes_.size();
  deform(t, y);
  set_increments(true);
  mpm::update_stress(system_, t - committed_time_);
  for (std::size_t body = 0; body < system_.bodies.size(); ++body) {
    Deformation& d = deformations_[body];
    for_particles(system_, body, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const FiniteStrain f = d.at(i);
        const SymmetricTensor& e = f.strain();
        d.committed_strain[0][i] = e.rr, d.committed_strain[1][i] = e.zz;
        d.committed_strain[2][i] = e.tt, d.committed_strain[3][i] = e.rz;
        d.committed_turn[i] = f.turn();
      }
    });
    for (std::size_t i = 0; i < system_.bodies[body].particles.size; ++i) {
      const SymmetricTensor e{d.committed_strain[0][i], d.committed_strain[1][i], d.committed_strain[2][i],
                              d.committed_strain[3][i]};
      deformation_ = std::max({deformation_, norm(e), std::abs(d.committed_turn[i])});
    }
  }
  committed_time_ = t;
  const double* q = changes_of_particles(y);
  system_.record.external_work = std::exchange(carried_work_, 0.0);
  system_.record.kinetic = start_kinetic_ + mass_.gain(q, start_velocity_.data()) + book_driven(t, q);
  changes_.resize(tail_);
  for (std::size_t k = 0; k < tail_; ++k)
    changes_[k] = y[2 * n + k] - std::exchange(committed_tail_[k], y[2 * n + k]);
  if (works_) system_.record.external_work += changes_.front();
  reactions_.commit(system_, y + size() + n);
  system_.record.particles_moved = false;
  if (!motions_.empty()) {
    const std::vector<mpm::Configuration> bodies = places();
    if (system_.contact) {
      system_.contact->evaluate(system_, bodies);
      system_.contact->commit(system_, bodies, changes_.data() + (works_ ? 1 : 0));
    }
  }
}

/// Adds the logarithmic strain of the phase, to second order in U - I, to those that domains follow: not
/// before the phase ends, whose nodes are those of its start.
void GridSystem::stretch_domains() {
  for (std::size_t body = 0; body < system_.bodies.size(); ++body) {
    Particles& p = system_.bodies[body].particles;
    if (!mpm::have_domains(p)) continue;
    const Deformation& d = deformations_[body];
    for (std::size_t i = 0; i < p.size; ++i) {
      const double rr = d.committed_strain[0][i], zz = d.committed_strain[1][i],
                   rz = d.committed_strain[3][i];
      const SymmetricTensor strain{rr - 0.5 * (rr * rr + rz * rz), zz - 0.5 * (zz * zz + rz * rz), 0.0,
                                   rz - 0.5 * rz * (rr + zz)};
      mpm::add_stretch(p, system_.bodies[body].column("effective_length"), i, strain, d.committed_turn[i]);
    }
  }
}

double GridSystem::end_phase(const double* y) {
  const double on_grid = system_.record.kinetic;
  stretch_domains();
  const std::vector<double> none(nodes_.size(), 0.0);
  mpm::fill_field(system_, nodes_, none.data(), held_at_start_, Field::velocity_0);
  mpm::fill_field(system_, nodes_, changes_of_particles(y), held_committed_, Field::new_velocity_0);
  mpm::gather(system_, mpm::Gather::velocity, 1.0);
  for (std::size_t body = 0; body < motions_.size(); ++body)
    system_.bodies[body].particles.turn = motions_[body].turn;
  for (std::size_t body = 0; system_.between_centroids && body < system_.bodies.size(); ++body)
    system_.bodies[body].particles.spin_increment = deformations_[body].committed_turn;  // particles turn so
  mpm::fill_field(system_, nodes_, y, mpm::boundary_ways(system_, start_time_, committed_time_),
                  Field::new_velocity_0);
  mpm::gather(system_, mpm::Gather::position, 1.0);
  mpm::update_domains(system_);
  system_.record.particles_moved = true;
  return on_grid - system_.record.kinetic;
}

}  // namespace vitrum
