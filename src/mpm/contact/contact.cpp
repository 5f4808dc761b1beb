#include "mpm/contact/contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace vitrum::mpm {
namespace {

PlacedPatch placed(const Patch& patch, const Configuration& at, std::size_t carrier) {
  const double turn = at.turn[carrier], side = at.mirrored[carrier], c = std::cos(turn), s = std::sin(turn);
  const Vector offset{side * patch.offset[0], patch.offset[1]};
  const Vector arm{c * offset[0] - s * offset[1], s * offset[0] + c * offset[1]};
  return {{at.position[0][carrier] + arm[0], at.position[1][carrier] + arm[1]},
          arm,
          turn + (side > 0.0 ? patch.angle : std::numbers::pi - patch.angle),
          patch.length,
          patch.ring};
}

Vector difference(const Vector& a, const Vector& b) {
  return {a[0] - b[0], a[1] - b[1]};
}

}  // namespace

std::vector<Configuration> configurations(const System& system) {
  std::vector<Configuration> list;
  for (const Body& body : system.bodies) {
    const Particles& p = body.particles;
    list.push_back({{p.position[0].data(), p.position[1].data()}, p.turn.data(), p.mirrored.data()});
  }
  return list;
}

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
      const std::size_t i = place_[body][patches_[k].carrier];
      velocity_.push_back({v[0][i], v[1][i]});
    }
  find_deep_particles(system);
  evaluate(system, configurations(system));
  note_state(system);
}

/// Those that stand in the second row or deeper: they touch nothing unless a crack has laid them open.
void Contact::find_deep_particles(const System& system) {
  place_patches(system, configurations(system));
  deep_.resize(system.bodies.size()), particle_places_.resize(system.bodies.size());
  for (std::size_t body = 0; body < system.bodies.size(); ++body) {
    const Particles& p = system.bodies[body].particles;
    deep_[body].assign(p.size, true);
    std::vector<Vector> places(p.size);
    for (std::size_t i = 0; i < p.size; ++i) places[p.identity[i]] = {p.position[0][i], p.position[1][i]};
    constexpr double second_row = 1.25;  // particle sides from the surface; the rows stand at 0.5 and 1.5
    const double near = 2.0 * second_row * system.bodies[body].particle_half_size;
    search_.find(places, places_of(body), near, [&](std::uint32_t i, std::uint32_t k) {
      const Vector d = difference(places[i], places_of(body)[k]);
      if (std::hypot(d[0], d[1]) < near) deep_[body][i] = false;
    });
  }
}

void Contact::find_carriers(const System& system) {
  if (found_ && sorted_ == system.grid.times_sorted()) return;
  place_.resize(system.bodies.size());
  for (std::size_t body = 0; body < system.bodies.size(); ++body) {
    const std::vector<std::uint32_t>& identity = system.bodies[body].particles.identity;
    place_[body].resize(identity.size());
    for (std::uint32_t i = 0; i < identity.size(); ++i) place_[body][identity[i]] = i;
  }
  found_ = true, sorted_ = system.grid.times_sorted();
}

void Contact::place_patches(const System& system, std::span<const Configuration> bodies) {
  find_carriers(system);
  placed_.resize(patches_.size()), places_.resize(patches_.size()), mirrored_.resize(patches_.size());
  for (std::size_t body = 0; body < bodies.size(); ++body)
    for (std::size_t k = first_[body]; k < first_[body + 1]; ++k) {
      const std::size_t i = place_[body][patches_[k].carrier];
      placed_[k] = placed(patches_[k], bodies[body], i), places_[k] = placed_[k].place;
      mirrored_[k] = bodies[body].mirrored[i];
    }
}

/// How far patches of two bodies that act on each other can be apart, m.
double Contact::reach(const BodyPair& pair) const {
  double length = 0.0;
  for (const std::size_t body : {pair.a, pair.b})
    for (const PlacedPatch& p : patches_of(body)) length = std::max(length, p.length);
  return std::hypot(length, 2.0 * pair.law.depth);
}

void Contact::find_touches(const System& system, std::span<const Configuration> bodies) {
  touches_.clear();
  gaps_.assign(pairs_.size(), std::numeric_limits<double>::infinity());
  for (std::size_t n = 0; n < pairs_.size(); ++n) {
    const BodyPair& pair = pairs_[n];
    const std::span<const PlacedPatch> a = patches_of(pair.a), b = patches_of(pair.b);
    search_.find(places_of(pair.a), places_of(pair.b), reach(pair), [&](std::uint32_t i, std::uint32_t j) {
      const PairForce force = pair_force(a[i], b[j], pair.law);
      if (force.overlap > 0.0 && force.gap > -pair.law.depth) gaps_[n] = std::min(gaps_[n], force.gap);
      if (!(force.energy > 0.0)) return;
      const auto patch_a = static_cast<std::uint32_t>(first_[pair.a] + i),
                 patch_b = static_cast<std::uint32_t>(first_[pair.b] + j);
      const Vector apart = difference(b[j].place, a[i].place);
      touches_.push_back({n,
                          patches_[patch_a].carrier,
                          patches_[patch_b].carrier,
                          patch_a,
                          patch_b,
                          a[i].arm,
                          b[j].arm,
                          {0.5 * apart[0], 0.5 * apart[1]},
                          force});
    });
    if (pair.may_break) find_touches_of_particles(system, bodies, n);
  }
}

/// Particles of which one at least lies deep: patches stand for all others.
void Contact::find_touches_of_particles(const System& system, std::span<const Configuration> bodies,
                                        std::size_t n) {
  const BodyPair& pair = pairs_[n];
  for (const std::size_t body : {pair.a, pair.b}) {
    const auto& position = bodies[body].position;
    std::vector<Vector>& places = particle_places_[body];
    places.resize(place_[body].size());
    for (std::size_t k = 0; k < places.size(); ++k)
      places[k] = {position[0][place_[body][k]], position[1][place_[body][k]]};
  }
  const Body &a = system.bodies[pair.a], &b = system.bodies[pair.b];
  const double distance = a.particle_half_size + b.particle_half_size;
  const double side = 2.0 * std::min(a.particle_half_size, b.particle_half_size);
  // The particle's ring at the start is in its mass.
  const auto ring_of = [&](const Body& body, std::size_t which, std::uint32_t identity) {
    const double square = 4.0 * body.particle_half_size * body.particle_half_size;
    return body.particles.mass[place_[which][identity]] / (body.material->density() * square);
  };
  search_.find(
      particle_places_[pair.a], particle_places_[pair.b], distance, [&](std::uint32_t i, std::uint32_t j) {
        if (!deep_[pair.a][i] && !deep_[pair.b][j]) return;
        const double area = side * std::min(ring_of(a, pair.a, i), ring_of(b, pair.b, j));
        const PairForce force =
            pair_force(particle_places_[pair.a][i], particle_places_[pair.b][j], distance, area, pair.law);
        if (!(force.energy > 0.0)) return;
        gaps_[n] = std::min(gaps_[n], force.gap);
        const auto arm = [&](double size) { return Vector{size * force.normal[0], size * force.normal[1]}; };
        const double half = 0.5 * force.gap;
        touches_.push_back({n,
                            i,
                            j,
                            none,
                            none,
                            arm(a.particle_half_size + half),
                            arm(-b.particle_half_size - half),
                            {},
                            force});
      });
}

std::vector<CarrierPair> Contact::foresee(double margin) {
  std::vector<CarrierPair> list;
  for (std::size_t n = 0; n < pairs_.size(); ++n) {
    const BodyPair& pair = pairs_[n];
    search_.find(places_of(pair.a), places_of(pair.b), reach(pair) + 2.0 * margin,
                 [&](std::uint32_t i, std::uint32_t j) {
                   list.push_back(carriers_of(n, patches_[first_[pair.a] + i].carrier,
                                              patches_[first_[pair.b] + j].carrier));
                 });
  }
  for (const Touch& t : touches_)
    if (t.patch_a == none) list.push_back(carriers_of(t.pair, t.carrier_a, t.carrier_b));
  return list;
}

bool Contact::evaluate(const System& system, std::span<const Configuration> bodies) {
  place_patches(system, bodies);
  find_touches(system, bodies);
  return !touches_.empty();
}

/// The state evaluated is the system's.
void Contact::note_state(System& system) {
  system.record.contact = 0.0;
  for (const Touch& t : touches_) system.record.contact += t.force.energy;
  for (std::size_t n = 0; n < pairs_.size(); ++n)
    history_[n].least_gap = std::min(history_[n].least_gap, gaps_[n]);
}

/// Friction on b, which slides over a with a velocity, as a function of the speed along the surfaces.
template <class Size>
Vector Contact::rub(const Touch& t, const Vector& sliding, const Size& size_of, double& power) const {
  const Vector along{-t.force.normal[1], t.force.normal[0]};
  const double slip = dot(sliding, along), speed = std::abs(slip);
  if (pairs_[t.pair].friction == 0.0 || speed == 0.0 || t.force.pressure == 0.0) return {};
  const double size = size_of(speed);
  power = size * speed;
  return {-std::copysign(size, slip) * along[0], -std::copysign(size, slip) * along[1]};
}

/// friction: on b.
void Contact::push(System& system, const Touch& t, const Vector& friction) const {
  const auto add = [&](std::size_t body, std::size_t carrier, const Vector& arm, const Vector& force,
                       double couple) {
    Particles& p = system.bodies[body].particles;
    if (p.contact_force[0].empty())
      for (std::vector<double>& column : p.contact_force) column.assign(p.size, 0.0);
    const std::size_t i = place_[body][carrier];
    p.contact_force[0][i] += force[0], p.contact_force[1][i] += force[1];
    p.contact_force[2][i] += couple + cross(arm, force);
  };
  const Vector on_b{t.force.force[0] + friction[0], t.force.force[1] + friction[1]};
  const double of_friction = cross(t.half, friction);  // which acts in the middle, on both
  add(pairs_[t.pair].b, t.carrier_b, t.arm_b, on_b, t.force.couple_b - of_friction);
  add(pairs_[t.pair].a, t.carrier_a, t.arm_a, {-on_b[0], -on_b[1]}, t.force.couple_a - of_friction);
}

void Contact::unload(System& system) {
  for (Body& body : system.bodies)
    for (std::vector<double>& column : body.particles.contact_force) column.clear();
}

void Contact::begin_step(System& system, double duration) {
  find_carriers(system);
  if (!evaluated_) evaluate(system, configurations(system));
  unload(system);
  system.record.friction = 0.0;
  for (const Touch& t : touches_) {
    const BodyPair& pair = pairs_[t.pair];
    const Particles &pa = system.bodies[pair.a].particles, &pb = system.bodies[pair.b].particles;
    const std::size_t ia = place_[pair.a][t.carrier_a], ib = place_[pair.b][t.carrier_b];
    const double ma = pa.mass[ia], mb = pb.mass[ib];
    const bool patches = t.patch_a != none;
    const Vector va = patches ? velocity_[t.patch_a] : Vector{pa.velocity[0][ia], pa.velocity[1][ia]},
                 vb = patches ? velocity_[t.patch_b] : Vector{pb.velocity[0][ib], pb.velocity[1][ib]};
    const auto size_of = [&](double speed) {  // it never turns sliding round within the step
      const double stopping = t.force.overlap * ma * mb / (ma + mb) * speed / (2.0 * duration);
      return std::min(pair.friction * t.force.pressure, stopping) * std::min(1.0, speed / slip_speed_);
    };
    double power = 0.0;
    const Vector friction = rub(t, difference(vb, va), size_of, power);
    push(system, t, friction);
    ContactHistory& history = history_[t.pair];
    for (std::size_t c = 0; c < 2; ++c) history.impulse[c] -= duration * (t.force.force[c] + friction[c]);
    history.friction_work += duration * power, system.record.friction += duration * power;
  }
  evaluated_ = false;
}

void Contact::end_step(System& system, double duration) {
  before_.swap(placed_), mirrored_before_.swap(mirrored_);
  evaluate(system, configurations(system));
  note_state(system);
  evaluated_ = true;
  for (std::size_t k = 0; k < patches_.size(); ++k) {
    const double side = mirrored_[k] == mirrored_before_[k] ? 1.0 : -1.0;
    velocity_[k] = {(placed_[k].place[0] - side * before_[k].place[0]) / duration,
                    (placed_[k].place[1] - before_[k].place[1]) / duration};
  }
}

bool Contact::rubs() const {
  return std::ranges::any_of(pairs_, [](const BodyPair& pair) { return pair.friction > 0.0; });
}

/// Velocity of b's patch relative to a's.
Vector Contact::sliding(const Touch& t, std::span<const ParticleMotion> motion) const {
  const BodyPair& pair = pairs_[t.pair];
  const auto velocity = [&](std::size_t body, std::size_t carrier, const Vector& arm) -> Vector {
    const ParticleMotion& m = motion[body];
    const std::size_t i = place_[body][carrier];
    return {m.velocity[0][i] - m.spin[i] * arm[1], m.velocity[1][i] + m.spin[i] * arm[0]};
  };
  if (pair.friction == 0.0) return {};
  const Vector arm_a{t.arm_a[0] + t.half[0], t.arm_a[1] + t.half[1]}, arm_b = difference(t.arm_b, t.half);
  return difference(velocity(pair.b, t.carrier_b, arm_b), velocity(pair.a, t.carrier_a, arm_a));
}

void Contact::load(System& system, std::span<const ParticleMotion> motion, double* rates) const {
  unload(system);
  std::fill(rates, rates + rates_of_pair * pairs_.size(), 0.0);
  for (const Touch& t : touches_) {
    const auto size_of = [&](double speed) {
      return pairs_[t.pair].friction * t.force.pressure * speed / std::hypot(speed, slip_speed_);
    };
    double power = 0.0;
    const Vector friction = rub(t, sliding(t, motion), size_of, power);
    push(system, t, friction);
    double* of_pair = rates + rates_of_pair * t.pair;
    for (std::size_t c = 0; c < 2; ++c) of_pair[c] -= t.force.force[c] + friction[c];
    of_pair[2] += power;
  }
}

/// Derivative of the size of friction to the speed of sliding, N s/m.
double Contact::damping(const Touch& t, std::span<const ParticleMotion> motion) const {
  const Vector along{-t.force.normal[1], t.force.normal[0]};
  const double relative = std::hypot(dot(sliding(t, motion), along) / slip_speed_, 1.0);
  return pairs_[t.pair].friction * t.force.pressure / (slip_speed_ * relative * relative * relative);
}

void Contact::commit(System& system, const double* changes) {
  note_state(system);
  system.record.friction = 0.0;
  for (ContactHistory& history : history_) {
    history.impulse[0] += changes[0], history.impulse[1] += changes[1];
    history.friction_work += changes[2], system.record.friction += changes[2];
    changes += rates_of_pair;
  }
}

std::vector<double> Contact::state() const {
  std::vector<double> values;
  for (const Vector& v : velocity_) values.insert(values.end(), v.begin(), v.end());
  for (const ContactHistory& h : history_)
    values.insert(values.end(), {h.impulse[0], h.impulse[1], h.friction_work, h.least_gap});
  return values;
}

bool Contact::restore(std::span<const double> state) {
  if (state.size() != 2 * velocity_.size() + 4 * history_.size()) return false;
  const double* next = state.data();
  for (Vector& v : velocity_) v = {next[0], next[1]}, next += 2;
  found_ = evaluated_ = false;
  for (ContactHistory& h : history_) h = {{next[0], next[1]}, next[2], next[3]}, next += 4;
  return true;
}

}  // namespace vitrum::mpm
