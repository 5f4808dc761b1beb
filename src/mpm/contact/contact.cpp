#include "mpm/contact/contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <unordered_map>

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
          patch.ring,
          patch.curvature};
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

Contact::Contact(System& system, std::vector<BodyPair> pairs, const std::vector<std::vector<Patch>>& patches)
    : pairs_(std::move(pairs)),
      history_(pairs_.size()),
      first_{0},
      next_field_(static_cast<std::int32_t>(system.bodies.size())) {
  for (const std::vector<Patch>& of_body : patches) {
    patches_.insert(patches_.end(), of_body.begin(), of_body.end());
    first_.push_back(patches_.size());
  }
  for (Body& body : system.bodies) {
    body.particles.turn.assign(body.particles.size, 0.0);
    body.particles.mirrored.assign(body.particles.size, 1.0);
  }
  find_carriers(system);
  find_deep_particles(system);
  if (std::ranges::any_of(pairs_, [](const BodyPair& pair) { return pair.a == pair.b; }))
    for (const Body& body : system.bodies) fragments_.emplace_back(body);
  std::vector<double> per_mass;
  for (std::size_t body = 0; body < system.bodies.size(); ++body) find_frequencies(system, body, per_mass);
  for (const BodyPair& pair : pairs_)
    frequencies_squared_.push_back(pair.law.stiffness * (per_mass[pair.a] + per_mass[pair.b]));
  const std::vector<Configuration> bodies = configurations(system);
  evaluate(system, bodies);
  keep(system, bodies);
}

/// The largest surface that one particle carries along one normal over its mass, m^2/kg (the largest
/// eigenvalue of sum length ring n n^T); that of a particle's own side where none is larger.
void Contact::find_frequencies(const System& system, std::size_t body, std::vector<double>& per_mass) const {
  const Body& of = system.bodies[body];
  double largest = 1.0 / (of.material->density() * 2.0 * of.particle_half_size);
  std::unordered_map<std::uint32_t, Vector> surfaces;  // sum length ring (1, cos 2 angle, sin 2 angle)
  std::unordered_map<std::uint32_t, double> areas;
  for (std::size_t k = first_[body]; k < first_[body + 1]; ++k) {
    const Patch& p = patches_[k];
    const double area = p.length * p.ring;
    areas[p.carrier] += area;
    Vector& s = surfaces[p.carrier];
    s[0] += area * std::cos(2.0 * p.angle), s[1] += area * std::sin(2.0 * p.angle);
  }
  for (const auto& [carrier, area] : areas) {
    const Vector& s = surfaces[carrier];
    largest =
        std::max(largest, 0.5 * (area + std::hypot(s[0], s[1])) / of.particles.mass[place_[body][carrier]]);
  }
  per_mass.push_back(largest);
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
  placed_.resize(patches_.size()), places_.resize(patches_.size());
  for (std::size_t body = 0; body < bodies.size(); ++body)
    for (std::size_t k = first_[body]; k < first_[body + 1]; ++k) {
      const std::size_t i = place_[body][patches_[k].carrier];
      placed_[k] = placed(patches_[k], bodies[body], i), places_[k] = placed_[k].place;
    }
}

bool Contact::evaluate(const System& system, std::span<const Configuration> bodies) {
  place_patches(system, bodies);
  find_touches(system, bodies);
  return !touches_.empty();
}

/// Makes the state evaluated the system's: its energy, its springs, and what has become heat on the way to
/// it.
void Contact::keep(System& system, std::span<const Configuration> bodies) {
  StepRecord& record = system.record;
  record.contact = record.friction = 0.0;
  const auto book = [&](const TouchKey& key, double lost) {
    record.friction += lost, history_[key.pair].friction_work += lost;
  };
  next_grips_.clear();
  auto former = grips_.begin();
  const auto let_go_until = [&](const auto& is_past) {
    for (; former != grips_.end() && !is_past(former->key); ++former)
      book(former->key, former->spring.energy());
  };
  for (const Touch& t : touches_) {
    record.contact += t.force.energy + t.friction.spring.energy();
    if (pairs_[t.key.pair].friction == 0.0) continue;
    let_go_until([&](const TouchKey& key) { return !(key < t.key); });
    if (former != grips_.end() && former->key == t.key) ++former;
    book(t.key, t.friction.lost);
    next_grips_.push_back(grip_of(t.key, t.friction.spring, bodies));
  }
  let_go_until([](const TouchKey&) { return false; });
  grips_.swap(next_grips_);
  for (std::size_t n = 0; n < pairs_.size(); ++n)
    history_[n].least_gap = std::min(history_[n].least_gap, gaps_[n]);
}

bool Contact::part(System& system) {
  bool parted = false;
  for (const BodyPair& pair : pairs_) {
    if (pair.a != pair.b) continue;
    Body& body = system.bodies[pair.a];
    const std::vector<std::int32_t> former = body.fragments;
    if (!fragments_[pair.a].part(body, next_field_)) continue;
    parted = true;
    find_carriers(system);
    const std::vector<Configuration> bodies = configurations(system);
    list_faces(bodies, pair.a);
    const std::span<const std::uint32_t> faces = fragments_[pair.a].faces();
    const double usual = 2.0 * body.particle_half_size;
    search_.find(particle_places_[pair.a], particle_places_[pair.a], usual,
                 [&](std::uint32_t k, std::uint32_t l) {
                   const std::uint32_t i = faces[k], j = faces[l];
                   if (i >= j || body.fragments[i] == body.fragments[j]) return;
                   if (!former.empty() && former[i] != former[j]) return;
                   const Vector apart = difference(particle_places_[pair.a][l], particle_places_[pair.a][k]);
                   if (const double distance = std::hypot(apart[0], apart[1]); distance < usual)
                     rests_.push_back({static_cast<std::uint32_t>(pair.a), i, j, distance});
                 });
    std::ranges::sort(rests_);
  }
  if (parted) system.grid_is_stale = true, evaluated_ = false;
  return parted;
}

double Contact::drop_removed(System& system) {
  find_carriers(system);
  const auto left = [&](const auto& of) { return has_left(system, of.key); };
  double stored = 0.0;
  for (const Touch& t : touches_)
    if (left(t)) stored += t.force.energy + t.friction.spring.energy();
  std::erase_if(touches_, left);
  std::erase_if(grips_, left);
  system.record.contact -= stored;
  return stored;
}

void Contact::settle(const System& system) {
  find_carriers(system);
  const std::vector<Configuration> bodies = configurations(system);
  for (Grip& grip : grips_) grip = grip_of(grip.key, grip.spring, bodies);
  evaluate(system, bodies);
}

void Contact::push(System& system, const Touch& t) const {
  const auto add = [&](std::size_t body, std::size_t carrier, const Vector& arm, const Vector& force,
                       double couple) {
    Particles& p = system.bodies[body].particles;
    if (p.contact_force[0].empty())
      for (std::vector<double>& column : p.contact_force) column.assign(p.size, 0.0);
    const std::size_t i = place_[body][carrier];
    p.contact_force[0][i] += force[0], p.contact_force[1][i] += force[1];
    p.contact_force[2][i] += couple + cross(arm, force);
  };
  const BodyPair& pair = pairs_[t.key.pair];
  const Vector friction = friction_on_b(t);
  const Vector on_b{t.force.force[0] + friction[0], t.force.force[1] + friction[1]};
  const double of_friction = cross(t.half, friction);  // which acts in the middle, on both
  add(pair.b, t.key.carrier_b, t.arm_b, on_b, t.force.couple_b - of_friction);
  add(pair.a, t.key.carrier_a, t.arm_a, {-on_b[0], -on_b[1]}, t.force.couple_a - of_friction);
}

void Contact::unload(System& system) {
  for (Body& body : system.bodies)
    for (std::vector<double>& column : body.particles.contact_force) column.clear();
}

void Contact::begin_step(System& system, double duration) {
  find_carriers(system);
  if (!evaluated_) settle(system);
  unload(system);
  for (const Touch& t : touches_) {
    push(system, t);
    if (pairs_[t.key.pair].a == pairs_[t.key.pair].b) continue;  // within the body
    const Vector friction = friction_on_b(t);
    for (std::size_t c = 0; c < 2; ++c)
      history_[t.key.pair].impulse[c] -= duration * (t.force.force[c] + friction[c]);
  }
  evaluated_ = false;
}

void Contact::end_step(System& system) {
  const std::vector<Configuration> bodies = configurations(system);
  evaluate(system, bodies);
  keep(system, bodies);
  evaluated_ = true;
}

void Contact::load(System& system, double* rates) const {
  unload(system);
  std::fill(rates, rates + rates_of_pair * pairs_.size(), 0.0);
  for (const Touch& t : touches_) {
    push(system, t);
    if (pairs_[t.key.pair].a == pairs_[t.key.pair].b) continue;  // within the body
    const Vector friction = friction_on_b(t);
    for (std::size_t c = 0; c < 2; ++c)
      rates[rates_of_pair * t.key.pair + c] -= t.force.force[c] + friction[c];
  }
}

void Contact::commit(System& system, std::span<const Configuration> bodies, const double* changes) {
  keep(system, bodies);
  for (ContactHistory& history : history_) {
    history.impulse[0] += changes[0], history.impulse[1] += changes[1];
    changes += rates_of_pair;
  }
}

}  // namespace vitrum::mpm
