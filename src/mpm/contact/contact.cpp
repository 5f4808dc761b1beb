#include "mpm/contact/contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vitrum::mpm {
namespace {

PlacedPatch placed(const Patch& patch, const Particles& p, std::size_t carrier) {
  const double turn = p.turn[carrier], side = p.mirrored[carrier], c = std::cos(turn), s = std::sin(turn);
  const Vector offset{side * patch.offset[0], patch.offset[1]};
  const Vector arm{c * offset[0] - s * offset[1], s * offset[0] + c * offset[1]};
  return {{p.position[0][carrier] + arm[0], p.position[1][carrier] + arm[1]},
          arm,
          turn + (side > 0.0 ? patch.angle : std::numbers::pi - patch.angle),
          patch.length,
          patch.ring};
}

void clear_forces(Particles& p) {
  for (std::vector<double>& column : p.contact_force) column.clear();
}

}  // namespace

Contact::Contact(System& system, std::vector<BodyPair> pairs, const std::vector<std::vector<Patch>>& patches,
                 double slip_speed)
    : pairs_(std::move(pairs)), history_(pairs_.size()), slip_speed_(slip_speed), first_{0} {
  for (const std::vector<Patch>& of_body : patches) {
    patches_.insert(patches_.end(), of_body.begin(), of_body.end());
    first_.push_back(patches_.size());
  }
  for (Body& body : system.bodies) {
    body.particles.turn.assign(body.particles.size, 0.0);
    body.particles.mirrored.assign(body.particles.size, 1.0);
  }
  find_carriers(system);
  for (std::size_t body = 0; body < system.bodies.size(); ++body)
    for (std::size_t k = first_[body]; k < first_[body + 1]; ++k) {
      const auto& v = system.bodies[body].particles.velocity;
      velocity_.push_back({v[0][carrier_[k]], v[1][carrier_[k]]});
    }
  system.record.contact = evaluate(system);
}

void Contact::find_carriers(const System& system) {
  if (found_ && sorted_ == system.grid.times_sorted()) return;
  carrier_.resize(patches_.size());
  std::vector<std::uint32_t> place;
  for (std::size_t body = 0; body < system.bodies.size(); ++body) {
    const std::vector<std::uint32_t>& identity = system.bodies[body].particles.identity;
    place.resize(identity.size());
    for (std::uint32_t i = 0; i < identity.size(); ++i) place[identity[i]] = i;
    for (std::size_t k = first_[body]; k < first_[body + 1]; ++k) carrier_[k] = place[patches_[k].carrier];
  }
  found_ = true, sorted_ = system.grid.times_sorted();
}

void Contact::place_patches(const System& system) {
  find_carriers(system);
  placed_.resize(patches_.size()), mirrored_.resize(patches_.size());
  for (std::size_t body = 0; body < system.bodies.size(); ++body) {
    const Particles& p = system.bodies[body].particles;
    for (std::size_t k = first_[body]; k < first_[body + 1]; ++k)
      placed_[k] = placed(patches_[k], p, carrier_[k]), mirrored_[k] = p.mirrored[carrier_[k]];
  }
}

void Contact::find_touches() {
  touches_.clear();
  for (std::size_t n = 0; n < pairs_.size(); ++n) {
    const auto [a, b, law, friction] = pairs_[n];
    const std::span<const PlacedPatch> all(placed_), of_a = all.subspan(first_[a], first_[a + 1] - first_[a]),
                                                     of_b = all.subspan(first_[b], first_[b + 1] - first_[b]);
    double length = 0.0;
    for (const auto& patches : {of_a, of_b})
      for (const PlacedPatch& p : patches) length = std::max(length, p.length);
    search_.find(of_a, of_b, std::hypot(length, 2.0 * law.depth), [&](std::uint32_t i, std::uint32_t j) {
      const PairForce force = pair_force(of_a[i], of_b[j], law);
      if (force.overlap > 0.0 && force.gap > -law.depth)
        history_[n].least_gap = std::min(history_[n].least_gap, force.gap);
      if (force.energy > 0.0)
        touches_.push_back(
            {n, i + static_cast<std::uint32_t>(first_[a]), j + static_cast<std::uint32_t>(first_[b]), force});
    });
  }
}

double Contact::evaluate(const System& system) {
  place_patches(system);
  find_touches();
  evaluated_ = true;
  double energy = 0.0;
  for (const Touch& t : touches_) energy += t.force.energy;
  return energy;
}

/// The force of friction on b, and its work in a step. It never turns sliding round within the step.
Vector Contact::rub(const System& system, const Touch& t, double duration, double& work) const {
  const BodyPair& pair = pairs_[t.pair];
  const Vector along{-t.force.normal[1], t.force.normal[0]};
  const double slip = dot(velocity_[t.b], along) - dot(velocity_[t.a], along), speed = std::abs(slip);
  if (pair.friction == 0.0 || speed == 0.0 || t.force.pressure == 0.0) return {};
  const double ma = system.bodies[pair.a].particles.mass[carrier_[t.a]],
               mb = system.bodies[pair.b].particles.mass[carrier_[t.b]];
  const double stopping = t.force.overlap * ma * mb / (ma + mb) * speed / (2.0 * duration);
  const double size =
      std::min(pair.friction * t.force.pressure, stopping) * std::min(1.0, speed / slip_speed_);
  work = size * speed * duration;
  const double signed_size = -std::copysign(size, slip);
  return {signed_size * along[0], signed_size * along[1]};
}

void Contact::push(System& system, std::size_t patch, std::size_t body, const Vector& force,
                   double couple) const {
  Particles& p = system.bodies[body].particles;
  if (p.contact_force[0].empty())
    for (std::vector<double>& column : p.contact_force) column.assign(p.size, 0.0);
  const std::size_t i = carrier_[patch];
  p.contact_force[0][i] += force[0], p.contact_force[1][i] += force[1];
  p.contact_force[2][i] += couple + cross(placed_[patch].arm, force);
}

void Contact::begin_step(System& system, double duration) {
  find_carriers(system);
  if (!evaluated_) system.record.contact = evaluate(system);
  for (Body& body : system.bodies) clear_forces(body.particles);
  system.record.friction = 0.0;
  for (const Touch& t : touches_) {
    const BodyPair& pair = pairs_[t.pair];
    double work = 0.0;
    const Vector friction = rub(system, t, duration, work);
    const Vector on_b{t.force.force[0] + friction[0], t.force.force[1] + friction[1]};
    push(system, t.b, pair.b, on_b, t.force.couple_b);
    push(system, t.a, pair.a, {-on_b[0], -on_b[1]}, t.force.couple_a);
    ContactHistory& history = history_[t.pair];
    for (std::size_t c = 0; c < 2; ++c) history.impulse[c] -= duration * on_b[c];
    history.friction_work += work, system.record.friction += work;
  }
  evaluated_ = false;
}

void Contact::end_step(System& system, double duration) {
  before_.swap(placed_), mirrored_before_.swap(mirrored_);
  system.record.contact = evaluate(system);
  for (std::size_t k = 0; k < patches_.size(); ++k) {
    const double side = mirrored_[k] == mirrored_before_[k] ? 1.0 : -1.0;
    velocity_[k] = {(placed_[k].place[0] - side * before_[k].place[0]) / duration,
                    (placed_[k].place[1] - before_[k].place[1]) / duration};
  }
}

std::vector<double> Contact::state() const {
  std::vector<double> values;
  for (const Vector& v : velocity_) values.insert(values.end(), v.begin(), v.end());
  for (const ContactHistory& h : history_)
    values.insert(values.end(), {h.impulse[0], h.impulse[1], h.friction_work, h.least_gap});
  return values;
}

bool Contact::restore(const System& system, std::span<const double> state) {
  if (state.size() != 2 * velocity_.size() + 4 * history_.size()) return false;
  const double* next = state.data();
  for (Vector& v : velocity_) v = {next[0], next[1]}, next += 2;
  found_ = false;
  evaluate(system);
  for (ContactHistory& h : history_) h = {{next[0], next[1]}, next[2], next[3]}, next += 4;
  return true;
}

}  // namespace vitrum::mpm
