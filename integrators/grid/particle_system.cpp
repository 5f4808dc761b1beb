#include "integrators/grid/particle_system.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "integrators/grid/critical_step.hpp"
#include "integrators/grid/particle_chunks.hpp"
#include "integrators/grid/step_pacing.hpp"
#include "mpm/axis.hpp"
#include "mpm/carried.hpp"
#include "mpm/centroids.hpp"
#include "mpm/contact/contact.hpp"
#include "mpm/domain.hpp"
#include "mpm/filter.hpp"
#include "mpm/loads.hpp"
#include "mpm/stress.hpp"
#include "mpm/velocity_filter.hpp"
#include "tensor/symmetric.hpp"

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

/// Positions and velocities of the trial in place. Particles beyond the axis are represented by their images.
void ParticleSystem::load(const double* y) {
  Flag beyond;
  for_each_part([&](const Part& part, std::size_t) {
    Particles& p = system_.bodies[part.body].particles;
    for (std::size_t c = 0; c < 2; ++c) {
      const double *d = y + place(part.body, displacement + c), *v = y + place(part.body, velocity + c);
      const double* from = start_[part.body].position[c].data();
      double *x = p.position[c].data(), *to = p.velocity[c].data();
#pragma GCC ivdep
      for (std::size_t i = part.begin; i < part.end; ++i) x[i] = from[i] + d[i], to[i] = v[i];
    }
    if (!system_.axisymmetric) return;
    const double* r = p.position[0].data();
    int some = 0;
#pragma omp simd reduction(| : some)
    for (std::size_t i = part.begin; i < part.end; ++i) some |= r[i] < 0.0 ? 1 : 0;
    if (some != 0) beyond.raise();
  });
  for (std::size_t n = 0; n < system_.bodies.size(); ++n) {
    mirrored_[n].clear();
    Particles& p = system_.bodies[n].particles;
    for (std::size_t i = 0; beyond.raised() && i < p.size; ++i)
      if (p.position[0][i] < 0.0) {
        mirrored_[n].push_back(i);
        p.position[0][i] = -p.position[0][i], p.velocity[0][i] = -p.velocity[0][i];
      }
  }
}

namespace {

/// Turns the changes of strain since the last commit into the frame that has turned by `turn`.
template <bool small>
void turn_changes(std::size_t begin, std::size_t end, const TensorPointers<const double>& strain,
                  const TensorPointers<const double>& committed, const double* turn,
                  const TensorPointers<double>& to) {
  const auto [e0, e1, e2, e3] = strain;
  const auto [c0, c1, c2, c3] = committed;
  const auto [to0, to1, to2, to3] = to;
#pragma GCC ivdep
  for (std::size_t i = begin; i < end; ++i) {
    const SymmetricTensor change = rotate({e0[i] - c0[i], e1[i] - c1[i], e2[i] - c2[i], e3[i] - c3[i]},
                                          small ? rotation_by_small(turn[i]) : rotation_by(turn[i]));
    to0[i] = change.rr, to1[i] = change.zz, to2[i] = change.tt, to3[i] = change.rz;
  }
}

double largest_of(const double* values, std::size_t begin, std::size_t end) {
  double largest = 0.0;
#pragma omp simd reduction(max : largest)
  for (std::size_t i = begin; i < end; ++i) largest = std::max(largest, std::abs(values[i]));
  return largest;
}

}  // namespace

/// Strain and turn since the last commit, in the frame of the committed state. Whether there are any.
bool ParticleSystem::set_increments(const double* y) {
  Flag changed;
  for_each_part([&](const Part& part, std::size_t) {
    const auto [n, begin, end] = part;
    Particles& p = system_.bodies[n].particles;
    const Start& start = start_[n];
    const TensorPointers<const double> e = strain_arrays(n, y);
    const double *w = y + place(n, turn()), *turned = start.turn.data();
    TensorPointers<const double> committed{};
    TensorPointers<double> to{};
    bool same = std::equal(w + begin, w + end, turned + begin);
    for (std::size_t k = 0; k < 4; ++k) {
      committed[k] = start.strain[k].data(), to[k] = p.strain_increment[k].data();
      same = same && std::equal(e[k] + begin, e[k] + end, committed[k] + begin);
    }
    if (!same) changed.raise();
    if (largest_of(turned, begin, end) <= small_angle)
      turn_changes<true>(begin, end, e, committed, turned, to);
    else
      turn_changes<false>(begin, end, e, committed, turned, to);
    double* spin = p.spin_increment.data();
    for (std::size_t i = begin; i < end; ++i) spin[i] = w[i] - turned[i];
  });
  return changed.raised();
}

/// Stress of the trial. The committed one where nothing has happened yet.
void ParticleSystem::try_stress(double t, bool changed) {
  if (changed) {
    mpm::try_stress(system_, trial_, std::max(0.0, t - committed_time_));
  } else {
    for (std::size_t n = 0; n < system_.bodies.size(); ++n) {
      system_.bodies[n].particles.elastic_strain = trial_.of(n).elastic_strain;
      system_.bodies[n].particles.tried_stress = mpm::stress_of(system_.bodies[n]);
    }
  }
}

bool ParticleSystem::rates(double t, const double* y, double* rates) {
  set_loads(t);
  const mpm::Trial::Scope scope(system_, trial_);
  load(y);
  mpm::refresh_grid_for_positions(system_);
  const bool changed = set_increments(y);
  mpm::try_domains(system_);
  mpm::find_centroids(system_);
  try_stress(t, changed);
  for (std::size_t n = 0; n < system_.bodies.size(); ++n)
    for (const std::size_t i : mirrored_[n]) {
      double& shear = system_.bodies[n].particles.tried_stress[3][i];
      shear = -shear;
    }
  std::fill(rates + tail_, rates + size_, 0.0);
  if (!turned_.empty()) {
    const std::vector<mpm::Configuration> bodies = places(y);
    if (system_.contact && system_.contact->evaluate(system_, bodies))
      system_.contact->load(system_, rates + tail_ + (works_ ? 1 : 0));
    if (system_.tractions) system_.tractions->load(system_, t, bodies);
  }
  mpm::scatter(system_, mpm::Scatter::momentum_and_force);
  mpm::Contact::unload(system_);
  mpm::project_velocities(system_);
  std::vector<mpm::ParticleRates> targets(system_.bodies.size());
  for (std::size_t n = 0; n < system_.bodies.size(); ++n) {
    const auto at = [&](std::size_t array) { return rates + place(n, array); };
    mpm::ParticleRates& r = targets[n];
    r.position = {at(displacement), at(displacement + 1)};
    r.velocity = {at(velocity), at(velocity + 1)};
    const bool hoop = system_.axisymmetric;
    r.strain = {at(strain), at(strain + 1), hoop ? at(strain + 2) : start_[n].no_strain.data(),
                at(strain + (hoop ? 3 : 2))};
    r.spin = at(turn());
    r.turn = y + place(n, turn());
  }
  double power = mpm::accelerate(system_);
  reactions_.rates(system_, rates + size_);
  mpm::gather_rates(system_, targets);
  if (system_.tractions) power += system_.tractions->power(motions(targets));
  mirror_rates(y, rates);
  if (works_) rates[tail_] = power;
  not_finite_ = is_finite(rates) ? std::nullopt : first_not_finite(rates, size_);
  return !not_finite_;
}

std::vector<mpm::ParticleMotion> ParticleSystem::motions(std::span<const mpm::ParticleRates> rates) {
  std::vector<mpm::ParticleMotion> motion;
  for (const mpm::ParticleRates& r : rates) motion.push_back({{r.position[0], r.position[1]}, r.spin});
  return motion;
}

/// Where the surfaces of bodies are in the trial in place.
std::vector<mpm::Configuration> ParticleSystem::places(const double* y) {
  std::vector<mpm::Configuration> bodies = mpm::configurations(system_);
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    const Particles& p = system_.bodies[n].particles;
    auto& [turned, side] = turned_[n];
    const double *w = y + place(n, turn()), *committed = start_[n].turn.data();
    side = p.mirrored;
    for (std::size_t i = 0; i < p.size; ++i) turned[i] = p.turn[i] + (w[i] - committed[i]);
    for (const std::size_t i : mirrored_[n]) turned[i] = -turned[i], side[i] = -side[i];
    bodies[n].turn = turned.data(), bodies[n].mirrored = side.data();
  }
  return bodies;
}

/// Whether all values are finite.
bool ParticleSystem::is_finite(const double* values) const {
  Flag found;
  for_each_range([&](std::size_t, std::size_t begin, std::size_t end) {
    if (first_not_finite(values + begin, end - begin)) found.raise();
  });
  return !found.raised();
}

/// Rates of the images become those of the particles beyond the axis: odd components change their sign. The
/// strain rate of an image was turned by the particle's own turn, which is the opposite of the image's.
void ParticleSystem::mirror_rates(const double* y, double* rates) const {
  for (std::size_t n = 0; n < system_.bodies.size(); ++n)
    for (const std::size_t i : mirrored_[n]) {
      const auto at = [&](std::size_t array) -> double& { return rates[place(n, array) + i]; };
      const Rotation turned = rotation_by(-y[place(n, turn()) + i]), back{turned.cosine, -turned.sine};
      SymmetricTensor e = rotate({at(strain), at(strain + 1), at(strain + 2), at(strain + 3)}, back);
      e.rz = -e.rz;
      e = rotate(e, turned);
      at(strain) = e.rr, at(strain + 1) = e.zz, at(strain + 2) = e.tt, at(strain + 3) = e.rz;
      for (const std::size_t array : {displacement, velocity, turn()}) at(array) = -at(array);
    }
}

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
  const bool parted = system_.contact && (system_.step_index + 1) % mpm::Contact::steps_between_looks == 0 &&
                      system_.contact->part(system_);
  return replaced || smoothed || carried || filtered || parted;
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
