#include "integrators/grid/particle_system.hpp"

#include <algorithm>
#include <cmath>

#include "integrators/grid/critical_step.hpp"
#include "mpm/carried.hpp"
#include "mpm/contact/contact.hpp"
#include "mpm/loads.hpp"

namespace vitrum {

ParticleSystem::ParticleSystem(System& system, const ErrorScales& scales, double tolerance,
                               double oscillation_limit)
    : system_(system),
      scales_(scales),
      tolerance_(tolerance),
      oscillation_limit_(oscillation_limit),
      works_(mpm::has_external_work(system)),
      trial_(system, mpm::Trial::Moves::particles),
      reactions_(system),
      start_(system.bodies.size()),
      mirrored_(system.bodies.size()) {
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    const std::size_t particles = system.bodies[n].particles.size;
    system.bodies[n].particles.keep_increments();
    for (std::size_t i = 0; i < particles; i += most_in_part)
      parts_.push_back({n, i, std::min(particles, i + most_in_part)});
    first_.push_back(size_);
    size_ += arrays() * particles;
    for (auto& column : start_[n].strain) column.assign(particles, 0.0);
    start_[n].turn.assign(particles, 0.0);
    last_strain_.emplace_back(particles, 0.0);
    if (!system.axisymmetric) start_[n].no_strain.assign(particles, 0.0);
  }
  tail_ = size_;
  if (works_) ++size_;
  if (system.contact) {
    size_ += mpm::Contact::rates_of_pair * system.contact->pairs().size();
  }
  if (system.contact || system.tractions)
    for (const Body& body : system.bodies) turned_.push_back({body.particles.turn, body.particles.mirrored});
  of_parts_.resize(parts_.size());
}

TensorPointers<const double> ParticleSystem::strain_arrays(std::size_t body, const double* y) const {
  const double* first = y + place(body, strain);
  const std::size_t n = system_.bodies[body].particles.size;
  if (system_.axisymmetric) return {first, first + n, first + 2 * n, first + 3 * n};
  return {first, first + n, start_[body].no_strain.data(), first + 2 * n};
}

void ParticleSystem::begin(double* y, double load_change) {
  load_change_ = load_change;
  // Always, so that the order of the unknowns follows from the positions, not from the history.
  system_.grid_is_stale = true;
  set_loads(system_.time);
  system_.grid.move_boundaries(system_.time);
  mpm::refresh_grid(system_, mpm::Storage::sorted);
  carried_work_ = mpm::carry_held(system_, carrying_slack()).work;
  order_parts();
  std::fill(y, y + size_, 0.0);
  reactions_.begin(y + size_);
  for (std::size_t n = 0; n < system_.bodies.size(); ++n) {
    const Particles& p = system_.bodies[n].particles;
    start_[n].position = p.position;
    for (auto& column : start_[n].strain) std::fill(column.begin(), column.end(), 0.0);
    std::fill(start_[n].turn.begin(), start_[n].turn.end(), 0.0);
    for (std::size_t c = 0; c < 2; ++c)
      std::copy(p.velocity[c].begin(), p.velocity[c].end(), y + place(n, velocity + c));
  }
  for (std::vector<double>& norms : last_strain_) std::fill(norms.begin(), norms.end(), 0.0);
  committed_time_ = system_.time;
  committed_tail_.assign(size_ - tail_, 0.0);
}

void ParticleSystem::set_loads(double t) {
  mpm::set_loads(system_, t, load_change_, mpm::Accelerations::taken);
}

/// What a particle may differ by from nodes whose velocity varies.
double ParticleSystem::carrying_slack() const {
  return tolerance_ * scales_.velocity;
}

double ParticleSystem::stable_step(double /*t*/, const double* y) {
  for_each_part([&](const Part& part, std::size_t k) {
    const double *v0 = y + place(part.body, velocity), *v1 = y + place(part.body, velocity + 1);
    double largest = 0.0;
    for (std::size_t i = part.begin; i < part.end; ++i)
      largest = std::max(largest, v0[i] * v0[i] + v1[i] * v1[i]);
    of_parts_[k] = largest;
  });
  // The particle system's largest frequency is at most 2 sqrt(2) (c + |v|) / h for any particle positions.
  double speed = 0.0, fastest = 0.0;
  for (std::size_t k = 0; k < parts_.size(); ++k) {
    const double v = std::sqrt(of_parts_[k]);
    speed = std::max(speed, system_.bodies[parts_[k].body].material->wave_speed() + v);
    fastest = std::max(fastest, v);
  }
  const double step = oscillation_limit_ / std::sqrt(8.0) * system_.cell;
  contact_limits_ = false;
  for (std::size_t n = 0; system_.contact && n < system_.contact->pairs().size(); ++n) {
    if (!(system_.contact->gap(n) <= 2.0 * fastest * step / speed)) continue;
    const double stiff = speed_as_stiff(system_.contact->frequency_squared(n), system_.cell);
    if (stiff > speed) speed = stiff, contact_limits_ = true;
  }
  return step / speed;
}

}  // namespace vitrum
