#include "integrators/grid/grid_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "integrators/grid/particle_chunks.hpp"
#include "integrators/grid/step_pacing.hpp"
#include "mpm/carried.hpp"
#include "mpm/centroids.hpp"
#include "mpm/domain.hpp"
#include "mpm/loads.hpp"
#include "mpm/stress.hpp"

namespace vitrum {

using mpm::Field;
using mpm::FiniteStrain;

GridSystem::GridSystem(System& system, const ErrorScales& scales, double tolerance, double travel)
    : system_(system),
      scales_(scales),
      tolerance_(tolerance),
      works_(mpm::has_external_work(system)),
      tail_((works_ ? 1 : 0) +
            (system.contact ? mpm::Contact::rates_of_pair * system.contact->pairs().size() : 0)),
      travel_(travel),
      trial_(system, mpm::Trial::Moves::nodes),
      reactions_(system),
      deformations_(system.bodies.size()),
      motions_(system.contact || system.tractions ? system.bodies.size() : 0) {
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    const std::size_t particles = system.bodies[n].particles.size;
    system.bodies[n].particles.keep_increments();
    mpm::ParticleGradient targets{};
    for (std::size_t k = 0; k < 5; ++k) {
      deformations_[n].gradient[k].assign(particles, 0.0);
      targets.gradient[k] = deformations_[n].gradient[k].data();
    }
    if (!motions_.empty()) {
      Motion& m = motions_[n];
      for (auto* columns : {&m.displacement, &m.position})
        for (std::vector<double>& column : *columns) column.assign(particles, 0.0);
      m.turn.assign(particles, 0.0);
      targets.value = {m.displacement[0].data(), m.displacement[1].data()};
      if (system.tractions) {
        for (std::vector<double>& column : m.velocity) column.assign(particles, 0.0);
        for (std::vector<double>& column : m.velocity_gradient) column.assign(particles, 0.0);
        m.spin.assign(particles, 0.0);
      }
    }
    gradients_.push_back(targets);
  }
}

void GridSystem::begin_phase() {
  set_loads(system_.time);
  held_at_start_ = held_committed_ = mpm::boundary_velocities(system_);
  system_.grid.move_boundaries(system_.time);
  if (system_.contact) system_.contact->part(system_);
  mpm::refresh_grid(system_, mpm::Storage::sorted);
  carried_work_ = mpm::carry_held(system_).work;
  mpm::find_centroids(system_);
  mpm::scatter(system_, mpm::Scatter::momentum);
  mpm::project_velocities(system_);
  mpm::number_unknowns(system_, nodes_);
  std::vector<mpm::CarrierPair> couplings;
  if (system_.contact) {
    system_.contact->settle(system_);
    couplings = system_.contact->foresee(system_, travel_ * system_.cell);
  }
  stiffness_.lay_out(system_, nodes_, couplings);
  mass_.assemble(system_, nodes_);
  pattern_ = mass_.times(stiffness_.pattern());
  diagonal_.resize(nodes_.size());
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    diagonal_[k] = static_cast<std::size_t>(std::find(pattern_.row.begin() + pattern_.column[k],
                                                      pattern_.row.begin() + pattern_.column[k + 1],
                                                      static_cast<std::int64_t>(k)) -
                                            pattern_.row.begin());
  start_velocity_.resize(nodes_.size());
  mpm::read_field(system_, nodes_, Field::velocity_0, start_velocity_.data());
  for (std::size_t n = 0; n < system_.bodies.size(); ++n) {
    const std::size_t particles = system_.bodies[n].particles.size;
    for (auto& column : deformations_[n].committed_strain) column.assign(particles, 0.0);
    deformations_[n].committed_turn.assign(particles, 0.0);
  }
  start_time_ = committed_time_ = system_.time;
  committed_tail_.assign(tail_, 0.0), deformation_ = driven_gain_ = 0.0;
  start_kinetic_ = mpm::kinetic_energy(system_);
  mean_mass_ = nodes_.size() == 0 ? 1.0
                                  : std::accumulate(nodes_.mass.begin(), nodes_.mass.end(), 0.0) /
                                        static_cast<double>(nodes_.size());
}

void GridSystem::start(double* y) {
  std::fill(y, y + size() + nodes_.size(), 0.0);
  reactions_.begin(y + size() + nodes_.size());
  std::copy(start_velocity_.begin(), start_velocity_.end(), y + nodes_.size());
}

/// Displacement gradients at y. Whether any strain is not that of the last commit.
bool GridSystem::deform(double t, const double* y) {
  mpm::fill_field(system_, nodes_, y, mpm::boundary_ways(system_, start_time_, t), Field::velocity_0);
  mpm::gather_gradient(system_, gradients_);
  Flag changed;
  for (std::size_t n = 0; n < system_.bodies.size(); ++n) {
    const Deformation& d = deformations_[n];
    for_particles(system_, n, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end && !changed.raised(); ++i) {
        const SymmetricTensor e = d.at(i).strain();
        if (e.rr != d.committed_strain[0][i] || e.zz != d.committed_strain[1][i] ||
            e.tt != d.committed_strain[2][i] || e.rz != d.committed_strain[3][i])
          changed.raise();
      }
    });
  }
  return changed.raised();
}

/// Where the particles are in the state deformed to. Patches turn by the antisymmetric part of the gradient:
/// what a couple acts on (scatter.cpp). (Phases are short; it is the turn to the second order.)
std::vector<mpm::Configuration> GridSystem::places() {
  std::vector<mpm::Configuration> bodies = mpm::configurations(system_);
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    const Particles& p = system_.bodies[n].particles;
    const auto& g = deformations_[n].gradient;
    Motion& m = motions_[n];
    for_particles(system_, n, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        for (std::size_t c = 0; c < 2; ++c) m.position[c][i] = p.position[c][i] + m.displacement[c][i];
        m.turn[i] = p.turn[i] + 0.5 * (g[2][i] - g[1][i]);
      }
    });
    bodies[n] = {{m.position[0].data(), m.position[1].data()}, m.turn.data(), p.mirrored.data()};
  }
  return bodies;
}

/// Whether bodies touch in that state.
bool GridSystem::touch() {
  return system_.contact && system_.contact->evaluate(system_, places());
}

/// How particles move at y, for the power of tractions. Fills the nodal velocity.
std::vector<mpm::ParticleMotion> GridSystem::motions(const double* y) {
  mpm::fill_field(system_, nodes_, y + nodes_.size(), mpm::boundary_velocities(system_), Field::velocity_0);
  std::vector<mpm::ParticleGradient> targets(motions_.size());
  std::vector<mpm::ParticleMotion> list;
  for (std::size_t n = 0; n < motions_.size(); ++n) {
    Motion& m = motions_[n];
    for (std::size_t k = 0; k < 5; ++k) targets[n].gradient[k] = m.velocity_gradient[k].data();
    targets[n].value = {m.velocity[0].data(), m.velocity[1].data()};
    list.push_back({{m.velocity[0].data(), m.velocity[1].data()}, m.spin.data()});
  }
  mpm::gather_gradient(system_, targets);
  for (std::size_t n = 0; n < motions_.size(); ++n)
    mpm::set_spins(system_.bodies[n].particles, targets[n], motions_[n].spin);
  return list;
}

/// Strain since the last commit, in the frame of the committed state. The spin takes the end of the increment
/// to the frame of the present (as_committed), or back to that of the phase's start, where forces are
/// computed.
void GridSystem::set_increments(bool as_committed) {
  for (std::size_t n = 0; n < system_.bodies.size(); ++n) {
    Particles& p = system_.bodies[n].particles;
    const Deformation& d = deformations_[n];
    for_particles(system_, n, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const FiniteStrain f = d.at(i);
        const SymmetricTensor before{d.committed_strain[0][i], d.committed_strain[1][i],
                                     d.committed_strain[2][i], d.committed_strain[3][i]};
        const SymmetricTensor change = rotate(f.strain() - before, rotation_by(d.committed_turn[i]));
        p.strain_increment[0][i] = change.rr, p.strain_increment[1][i] = change.zz;
        p.strain_increment[2][i] = change.tt, p.strain_increment[3][i] = change.rz;
        p.spin_increment[i] = (as_committed ? f.turn() : 0.0) - d.committed_turn[i];
      }
    });
  }
}

/// Nominal stress of the trial in place.
void GridSystem::try_stress(double t, bool changed) {
  if (changed) {
    mpm::try_stress(system_, trial_, std::max(0.0, t - committed_time_));
  } else {  // exactly the committed state, turned back to the phase's start
    for (std::size_t n = 0; n < system_.bodies.size(); ++n) {
      Particles& p = system_.bodies[n].particles;
      const auto& from = trial_.of(n).elastic_strain;
      for_particles(system_, n, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          const Rotation back = rotation_by(p.spin_increment[i]);
          auto& to = p.elastic_strain;
          const SymmetricTensor e = rotate({from[0][i], from[1][i], from[2][i], from[3][i]}, back);
          to[0][i] = e.rr, to[1][i] = e.zz, to[2][i] = e.tt, to[3][i] = e.rz;
        }
      });
      p.tried_stress = mpm::stress_of(system_.bodies[n]);
    }
  }
  for (std::size_t n = 0; n < system_.bodies.size(); ++n) {
    Particles& p = system_.bodies[n].particles;
    const Deformation& d = deformations_[n];
    for_particles(system_, n, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const FiniteStrain f = d.at(i);
        auto& s = p.tried_stress;
        const auto P = f.nominal({s[0][i], s[1][i], s[2][i], s[3][i]});
        s[0][i] = P[0], s[3][i] = P[1], p.tried_stress_zr[i] = P[2], s[1][i] = P[3];
      }
    });
  }
}

void GridSystem::set_loads(double t) {
  mpm::set_loads(system_, t, t, mpm::Accelerations::none);
}

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

bool GridSystem::rates(double t, const double* y, double* rates) {
  set_loads(t);
  const std::size_t n = nodes_.size();
  const bool changed = deform(t, y);
  std::fill(rates + 2 * n, rates + size(), 0.0);
  const bool touching = touch();
  std::vector<mpm::ParticleMotion> motion;
  if (system_.tractions) motion = motions(y);
  if (touching) system_.contact->load(system_, rates + 2 * n + (works_ ? 1 : 0));
  if (system_.tractions) system_.tractions->load(system_, t, places());
  {
    const mpm::Trial::Scope scope(system_, trial_);
    set_increments(false);
    try_stress(t, changed);
    mpm::scatter(system_, mpm::Scatter::force);
  }
  mpm::Contact::unload(system_);
  if (works_) mpm::fill_field(system_, nodes_, y + n, mpm::boundary_velocities(system_), Field::velocity_0);
  double power = mpm::accelerate(system_);
  if (system_.tractions) power += system_.tractions->power(motion);
  double* const accelerations = rates + size();
  reactions_.rates(system_, accelerations + n);
  std::copy(y + n, y + 2 * n, rates);
  mpm::read_field(system_, nodes_, Field::acceleration_0, accelerations);
  mass_.project(system_, accelerations, rates + n);
  if (works_) rates[2 * n] = power;
  not_finite_ = first_not_finite(rates, size());
  return !not_finite_;
}

bool GridSystem::linearise(double t, const double* y) {
  const bool changed = deform(t, y), touching = touch();
  const mpm::Trial::Scope scope(system_, trial_);
  set_increments(false);
  try_stress(t, changed);
  mpm::gather_tangents(system_, trial_, std::max(0.0, t - committed_time_), tangents_);
  stiffness_.assemble(system_, nodes_, gradients_, tangents_, stiffness_values_);
  if (touching)
    system_.contact->linearise(
        [&](const mpm::CarrierPair& pair, const mpm::Vector& force, const mpm::Vector& stretch,
            double stiffness) { stiffness_.add(pair, force, stretch, stiffness, stiffness_values_); });
  if (system_.tractions) {
    system_.tractions->load(system_, t, places());
    mpm::Contact::unload(system_);
    if (!system_.tractions->by_turn().empty())
      stiffness_.add_followers(system_, nodes_, system_.tractions->by_turn(), stiffness_values_);
  }
  mass_.times(stiffness_.pattern(), stiffness_values_, pattern_, mobile_stiffness_);
  double sum = 0.0;
  for (const double k : mobile_stiffness_) sum += k;
  return std::isfinite(sum);
}

void GridSystem::form(double gamma, double* values) const {
  // (I - gamma J) x = b with u' = v, m v' = M (1/m) f(u): eliminating x_u leaves (m + gamma^2 M (1/m) K) x_v
  // = m b_v - gamma M (1/m) K b_u.
  for (std::size_t k = 0; k < mobile_stiffness_.size(); ++k) values[k] = gamma * gamma * mobile_stiffness_[k];
  for (std::size_t k = 0; k < nodes_.size(); ++k) values[diagonal_[k]] += nodes_.mass[k];
}

void GridSystem::reduce(double gamma, const double* b, double* c) const {
  const std::size_t n = nodes_.size();
  for (std::size_t k = 0; k < n; ++k) c[k] = nodes_.mass[k] * b[n + k];
  for (std::size_t k = 0; k < n; ++k)
    for (auto e = static_cast<std::size_t>(pattern_.column[k]);
         e < static_cast<std::size_t>(pattern_.column[k + 1]); ++e)
      c[pattern_.row[e]] -= gamma * mobile_stiffness_[e] * b[k];
}

void GridSystem::expand(double gamma, const double* b, const double* z, double* x) const {
  const std::size_t n = nodes_.size();
  for (std::size_t k = 0; k < n; ++k) x[k] = b[k] + gamma * z[k], x[n + k] = z[k];
  std::copy(b + 2 * n, b + size(), x + 2 * n);  // depends on the others, not they on it
}

void GridSystem::carry(double from, double to, std::vector<double>& y) {
  const std::size_t all = size() + integrals();
  y.assign(all, 0.0);
  start(y.data());
  if (all == 0) return;
  const std::vector<double> still = y;
  std::vector<double> rate(all);
  for (const auto& [t, weight] : {std::pair(from, 1.0), {0.5 * (from + to), 4.0}, {to, 1.0}}) {
    rates(t, still.data(), rate.data());
    for (std::size_t k = 0; k < all; ++k) y[k] += weight * rate[k];
  }
  for (double& integral : y) integral *= (to - from) / 6.0;
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

double GridSystem::travel(const double* y) const {
  // A node of little mass may go far without any particle following it.
  double way = 0.0;
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    if (nodes_.mass[k] > 1e-3 * mean_mass_) way = std::max(way, std::abs(y[k]));
  return way / system_.cell;
}

/// Error weights contain the root of the mass: what counts is the error of momentum and of the work that
/// forces could do, not that of a node with next to no mass.
double GridSystem::weight_of_mass(std::size_t unknown) const {
  return std::sqrt(nodes_.mass[unknown % nodes_.size()] / mean_mass_);
}

double GridSystem::tolerance_of(std::size_t unknown) const {
  const std::size_t n = nodes_.size();
  const double scale = unknown < n ? scales_.strain * scales_.length
                       : unknown < 2 * n
                           ? scales_.velocity
                           : 1e6 * mean_mass_ * static_cast<double>(n) * scales_.velocity * scales_.velocity;
  return tolerance_ * scale / (unknown < 2 * n ? weight_of_mass(unknown) : 1.0);
}

void GridSystem::error_weights(double* weights) const {
  for (std::size_t k = 0; k < size(); ++k) weights[k] = 1.0 / tolerance_of(k);
}

void GridSystem::add_errors(const double* errors, ErrorEstimate& estimate) const {
  const std::size_t n = nodes_.size();
  if (n == 0) return;
  double displacement = 0.0, velocity = 0.0;
  for (std::size_t k = 0; k < n; ++k) {
    const double u = errors[k] * tolerance_ / tolerance_of(k),
                 v = errors[n + k] * tolerance_ / tolerance_of(n + k);
    displacement += u * u, velocity += v * v;
  }
  const auto count = static_cast<double>(n);
  estimate.position += std::sqrt(displacement / count);
  estimate.velocity += std::sqrt(velocity / count);
  estimate.total += std::sqrt((displacement + velocity) / (2.0 * count));
}

std::string GridSystem::describe(std::size_t unknown) const {
  const std::size_t n = nodes_.size();
  if (unknown >= 2 * n) return works_ && unknown == 2 * n ? "external work" : "impulse of contact";
  return fmt::format("{} {}", unknown < n ? "displacement" : "velocity",
                     mpm::describe_unknown(system_, nodes_, unknown % n));
}

}  // namespace vitrum
