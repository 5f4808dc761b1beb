// The rates of the particles: the state that is tried, through the grid.
#include <algorithm>
#include <cmath>

#include "integrators/grid/particle_chunks.hpp"
#include "integrators/grid/particle_system.hpp"
#include "integrators/grid/step_pacing.hpp"
#include "mpm/centroids.hpp"
#include "mpm/contact/contact.hpp"
#include "mpm/domain.hpp"
#include "mpm/stress.hpp"

namespace vitrum {

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
  rest_removed(rates);
  if (system_.tractions) power += system_.tractions->power(motions(targets));
  mirror_rates(y, rates);
  if (works_) rates[tail_] = power;
  not_finite_ = is_finite(rates) ? std::nullopt : first_not_finite(rates, size_);
  return !not_finite_;
}

/// Particles that have left the computation stay as they are.
void ParticleSystem::rest_removed(double* rates) const {
  for (std::size_t n = 0; n < system_.bodies.size(); ++n)
    for (std::size_t a = 0; a < arrays(); ++a)
      std::fill(rates + place(n, a) + system_.bodies[n].present(), rates + place(n, a + 1), 0.0);
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

}  // namespace vitrum
