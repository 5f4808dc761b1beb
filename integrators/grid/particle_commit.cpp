// What a step that is accepted leaves: the committed state, and what acts between steps.
#include <algorithm>
#include <numeric>
#include <utility>

#include "integrators/grid/particle_system.hpp"
#include "mpm/axis.hpp"
#include "mpm/carried.hpp"
#include "mpm/contact/contact.hpp"
#include "mpm/domain.hpp"
#include "mpm/filter.hpp"
#include "mpm/removal.hpp"
#include "mpm/stress.hpp"
#include "mpm/velocity_filter.hpp"

namespace vitrum {

bool ParticleSystem::commit(double t, double* y) {
  const double from = committed_time_, duration = t - from;
  set_loads(t);
  load(y);
  for (std::size_t n = 0; n < system_.bodies.size(); ++n)
    for (const std::size_t i : mirrored_[n]) {  // reflected below, after the increment
      Particles& p = system_.bodies[n].particles;
      p.position[0][i] = -p.position[0][i], p.velocity[0][i] = -p.velocity[0][i];
    }
  set_increments(y);
  mpm::update_stress(system_, duration);
  mpm::add_stretches(system_);
  mpm::update_domains(system_);
  for_each_part([&](const Part& part, std::size_t) {
    const auto [n, begin, end] = part;
    const TensorPointers<const double> e = strain_arrays(n, y);
    for (std::size_t k = 0; k < 4; ++k)
      std::copy(e[k] + begin, e[k] + end, start_[n].strain[k].data() + begin);
    const double* w = y + place(n, turn());
    std::copy(w + begin, w + end, start_[n].turn.data() + begin);
    const auto& change = system_.bodies[n].particles.strain_increment;
    if (!turned_.empty())
      for (std::size_t i = begin; i < end; ++i)
        system_.bodies[n].particles.turn[i] += system_.bodies[n].particles.spin_increment[i];
    for (std::size_t i = begin; i < end; ++i)
      last_strain_[n][i] = norm(SymmetricTensor{change[0][i], change[1][i], change[2][i], change[3][i]});
  });
  committed_time_ = t;
  system_.record.external_work = std::exchange(carried_work_, 0.0);
  changes_.resize(size_ - tail_);
  for (std::size_t k = tail_; k < size_; ++k)
    changes_[k - tail_] = y[k] - std::exchange(committed_tail_[k - tail_], y[k]);
  if (works_) system_.record.external_work += changes_.front();
  reactions_.commit(system_, y + size_);
  const bool replaced = reflect(y);
  if (system_.contact) {
    const std::vector<mpm::Configuration> bodies = mpm::configurations(system_);
    system_.contact->evaluate(system_, bodies);
    system_.contact->commit(system_, bodies, changes_.data() + (works_ ? 1 : 0));
  }
  system_.record.filtered = 0.0;
  const bool smoothed = filter_velocities();
  const bool carried = carry();
  const bool filtered = mpm::filter_pressures(system_, from, t);
  system_.record.kinetic = kinetic_energy();
  const bool removed = mpm::remove_particles(system_);
  const bool parted = system_.contact && (system_.step_index + 1) % mpm::Contact::steps_between_looks == 0 &&
                      system_.contact->part(system_);
  return replaced || smoothed || carried || filtered || removed || parted;
}

/// Whether velocities have changed.
bool ParticleSystem::filter_velocities() {
  if (system_.flip == 1.0) return false;
  mpm::refresh_grid_for_positions(system_);
  return mpm::filter_velocities(system_);
}

/// Particles that have come to move with held nodes take their velocity; whether some have.
bool ParticleSystem::carry() {
  if (system_.grid.boundaries().empty()) return false;
  mpm::refresh_grid_for_positions(system_);
  const mpm::Carried carried = mpm::carry_held(system_, carrying_slack());
  system_.record.external_work += carried.work;
  return carried.changed;
}

double ParticleSystem::kinetic_energy() {
  for_each_part([&](const Part& part, std::size_t k) {
    const Particles& p = system_.bodies[part.body].particles;
    const double *m = p.mass.data(), *v0 = p.velocity[0].data(), *v1 = p.velocity[1].data();
    double sum = 0.0;
#pragma omp simd reduction(+ : sum)
    for (std::size_t i = part.begin; i < part.end; ++i) sum += 0.5 * m[i] * (v0[i] * v0[i] + v1[i] * v1[i]);
    of_parts_[k] = sum;
  });
  return std::accumulate(of_parts_.begin(), of_parts_.end(), 0.0);
}

/// Particles that have crossed the axis change places with their images, in the system and in y.
bool ParticleSystem::reflect(double* y) {
  bool any = false;
  for (std::size_t n = 0; n < system_.bodies.size(); ++n)
    for (const std::size_t i : mirrored_[n]) {
      any = true;
      Particles& p = system_.bodies[n].particles;
      p.position[0][i] = -p.position[0][i];
      mpm::reflect_at_axis(p, i);
      start_[n].position[0][i] = -start_[n].position[0][i];
      start_[n].strain[3][i] = -start_[n].strain[3][i];
      start_[n].turn[i] = -start_[n].turn[i];
      for (const std::size_t array : {displacement, velocity, strain + 3, turn()}) {
        double& unknown = y[place(n, array) + i];
        unknown = -unknown;
      }
    }
  return any;
}

}  // namespace vitrum
