#include "mpm/tractions.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "mpm/blocks.hpp"
#include "mpm/stiffness.hpp"

namespace vitrum::mpm {

Tractions::Tractions(System& system, std::vector<Traction> tractions)
    : tractions_(std::move(tractions)), force_(system.bodies.size()), motions_(system.bodies.size()) {
  for (const Traction& traction : tractions_) place_.emplace_back(traction.points.size(), 0);
  for (Body& body : system.bodies) {
    body.particles.turn.assign(body.particles.size, 0.0);
    body.particles.mirrored.assign(body.particles.size, 1.0);
  }
}

bool Tractions::act_on(std::size_t body) const {
  return std::ranges::any_of(tractions_, [&](const Traction& t) { return t.body == body; });
}

/// Particles may have changed their places.
void Tractions::find_carriers(const System& system) {
  for (std::size_t n = 0; n < tractions_.size(); ++n) {
    const std::vector<std::uint32_t>& identity = system.bodies[tractions_[n].body].particles.identity;
    const std::vector<LoadedPoint>& points = tractions_[n].points;
    bool found = true;
    for (std::size_t k = 0; k < points.size() && found; ++k)
      found = identity[place_[n][k]] == points[k].carrier;
    if (found) continue;
    std::vector<std::uint32_t> place(identity.size());
    for (std::uint32_t i = 0; i < identity.size(); ++i) place[identity[i]] = i;
    for (std::size_t k = 0; k < points.size(); ++k) place_[n][k] = place[points[k].carrier];
  }
}

void Tractions::load(System& system, double time, std::span<const Configuration> bodies) {
  find_carriers(system);
  by_turn_.clear();
  for (std::size_t n = 0; n < force_.size(); ++n)
    for (std::vector<double>& column : force_[n])
      column.assign(act_on(n) ? system.bodies[n].particles.size : 0, 0.0);
  for (std::size_t n = 0; n < tractions_.size(); ++n) {
    const Traction& t = tractions_[n];
    auto& force = force_[t.body];
    for (std::size_t k = 0; k < t.points.size(); ++k) {
      const LoadedPoint& point = t.points[k];
      const std::size_t i = place_[n][k];
      if (i >= system.bodies[t.body].present()) continue;  // its carrier has left
      const double turn = bodies[t.body].turn[i], side = bodies[t.body].mirrored[i];
      const double c = std::cos(turn), s = std::sin(turn);
      const Vector arm{c * side * point.offset[0] - s * point.offset[1],
                       s * side * point.offset[0] + c * point.offset[1]};
      Vector f{};
      if (t.pressure) {
        const double size = -t.pressure->at(time, point.place) * point.area;
        const double angle =
            (side > 0.0 ? point.angle : std::numbers::pi - point.angle) + (t.follows ? turn : 0.0);
        f = {size * std::cos(angle), size * std::sin(angle)};
        if (t.follows) {
          Vector& slope = by_turn_[Stiffness::key_of(t.body, i)];
          slope[0] -= f[1], slope[1] += f[0];
        }
      } else {
        f = {side * point.area * t.vector[0]->at(time, point.place),
             point.area * t.vector[1]->at(time, point.place)};
      }
      force[0][i] += f[0], force[1][i] += f[1], force[2][i] += cross(arm, f);
    }
  }
  for (std::size_t n = 0; n < force_.size(); ++n) {
    if (force_[n][0].empty()) continue;
    auto& all = system.bodies[n].particles.contact_force;
    for (std::size_t k = 0; k < 3; ++k) {
      all[k].resize(force_[n][k].size(), 0.0);
      for (std::size_t i = 0; i < all[k].size(); ++i) all[k][i] += force_[n][k][i];
    }
  }
}

double Tractions::power(std::span<const ParticleMotion> motion) const {
  double sum = 0.0;
  for (std::size_t n = 0; n < force_.size(); ++n) {
    const auto& force = force_[n];
    for (std::size_t i = 0; i < force[0].size(); ++i)
      sum += force[0][i] * motion[n].velocity[0][i] + force[1][i] * motion[n].velocity[1][i] +
             force[2][i] * motion[n].spin[i];
  }
  return sum;
}

/// A couple moves nodes of next to no mass far, and no particle with them: the work is that at
/// v + m^-1 M (w - v) / 2, M the consistent mass, and not at (v + w) / 2.
void Tractions::book_work(System& system, double duration) {
  Grid& grid = system.grid;
  const std::size_t nodes = grid.blocks().size() * block_nodes;
  const std::array velocity{grid.field(Field::velocity_0), grid.field(Field::velocity_1)};
  const std::array<const double*, 2> after{grid.field(Field::new_velocity_0),
                                           grid.field(Field::new_velocity_1)};
  VectorColumns before;
  for (std::size_t c = 0; c < 2; ++c) {
    before[c].assign(velocity[c], velocity[c] + nodes);
    for (std::size_t n = 0; n < nodes; ++n) velocity[c][n] = after[c][n] - before[c][n];
  }
  interpolate(system);
  const auto swap_velocities = [&] {
    for (std::size_t n = 0; n < motions_.size(); ++n)
      for (std::size_t c = 0; c < 2; ++c) std::swap(system.bodies[n].particles.velocity[c], motions_[n][c]);
  };
  swap_velocities();
  scatter(system, Scatter::momentum);
  swap_velocities();
  const double* mass = grid.field(Field::mass);
  for (std::size_t c = 0; c < 2; ++c) {
    const double* momentum = grid.field(c == 0 ? Field::momentum_0 : Field::momentum_1);
    for (std::size_t n = 0; n < nodes; ++n) {
      const bool moves = mass[n] > 0.0 && grid.constraint(c, n) == Constraint::free;
      velocity[c][n] = before[c][n] + 0.5 * (moves ? momentum[n] / mass[n] : after[c][n] - before[c][n]);
    }
  }
  const std::vector<ParticleGradient> at = interpolate(system);
  std::vector<ParticleMotion> motion(motions_.size());
  for (std::size_t n = 0; n < motions_.size(); ++n) {
    set_spins(system.bodies[n].particles, at[n], motions_[n][6]);
    motion[n] = {{motions_[n][0].data(), motions_[n][1].data()}, motions_[n][6].data()};
  }
  system.record.external_work += duration * power(motion);
  for (std::size_t c = 0; c < 2; ++c) std::copy(before[c].begin(), before[c].end(), velocity[c]);
}

/// The nodes' velocities and their gradients at the particles, in `motions_`.
std::vector<ParticleGradient> Tractions::interpolate(System& system) {
  std::vector<ParticleGradient> targets(motions_.size());
  for (std::size_t n = 0; n < motions_.size(); ++n) {
    for (std::vector<double>& column : motions_[n]) column.resize(system.bodies[n].particles.size);
    for (std::size_t c = 0; c < 2; ++c) targets[n].value[c] = motions_[n][c].data();
    for (std::size_t k = 0; k < 5; ++k) targets[n].gradient[k] = motions_[n][2 + k].data();
  }
  gather_gradient(system, targets);
  return targets;
}

void set_spins(const Particles& p, const ParticleGradient& of, std::vector<double>& spin) {
  for (std::size_t i = 0; i < p.size; ++i) {
    spin[i] = 0.5 * (of.gradient[2][i] - of.gradient[1][i]);
    if (p.centroids[0].empty()) continue;
    of.value[0][i] -= spin[i] * p.from_centroids[1][i];
    of.value[1][i] += spin[i] * p.from_centroids[0][i];
  }
}

double Tractions::next_kink(double time) const {
  double next = std::numeric_limits<double>::infinity();
  for (const Traction& t : tractions_)
    for (const auto& load : {t.pressure, t.vector[0], t.vector[1]})
      if (load) next = std::min(next, load->next_kink(time));
  return next;
}

}  // namespace vitrum::mpm
