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
    if (pair.a == pair.b) {
      find_touches_of_fragments(system, bodies, n);
      continue;
    }
    const std::span<const PlacedPatch> a = patches_of(pair.a), b = patches_of(pair.b);
    search_.find(places_of(pair.a), places_of(pair.b), reach(pair), [&](std::uint32_t i, std::uint32_t j) {
      const PairForce force = pair_force(a[i], b[j], pair.law);
      if (force.overlap > 0.0 && force.gap > -pair.law.depth) gaps_[n] = std::min(gaps_[n], force.gap);
      if (!(force.energy > 0.0)) return;
      const auto patch_a = static_cast<std::uint32_t>(first_[pair.a] + i),
                 patch_b = static_cast<std::uint32_t>(first_[pair.b] + j);
      const Vector apart = difference(b[j].place, a[i].place);
      const TouchKey key{static_cast<std::uint32_t>(n), patch_a, patch_b, patches_[patch_a].carrier,
                         patches_[patch_b].carrier};
      touch(bodies, {key, a[i].arm, b[j].arm, {0.5 * apart[0], 0.5 * apart[1]}, force});
    });
    if (pair.may_break) find_touches_of_particles(system, bodies, n);
  }
}

/// Particles of which one at least lies deep: patches stand for all others.
void Contact::find_touches_of_particles(const System& system, std::span<const Configuration> bodies,
                                        std::size_t n) {
  const BodyPair& pair = pairs_[n];
  for (const std::size_t body : {pair.a, pair.b}) {
    std::vector<Vector>& places = particle_places_[body];
    places.resize(place_[body].size());
    for (std::uint32_t k = 0; k < places.size(); ++k) places[k] = place_of(bodies, body, k);
  }
  const double distance = system.bodies[pair.a].particle_half_size + system.bodies[pair.b].particle_half_size;
  search_.find(particle_places_[pair.a], particle_places_[pair.b], distance,
               [&](std::uint32_t i, std::uint32_t j) {
                 if (deep_[pair.a][i] || deep_[pair.b][j])
                   touch_as_circles(system, bodies, n, i, j, distance);
               });
}

/// Where the faces of a body's fragments are, in their order.
void Contact::list_faces(std::span<const Configuration> bodies, std::size_t body) {
  particle_places_[body].clear();
  for (const std::uint32_t face : fragments_[body].faces())
    particle_places_[body].push_back(place_of(bodies, body, face));
}

void Contact::find_touches_of_fragments(const System& system, std::span<const Configuration> bodies,
                                        std::size_t n) {
  const std::size_t body = pairs_[n].a;
  if (!fragments_[body].any()) return;
  list_faces(bodies, body);
  const std::span<const std::uint32_t> faces = fragments_[body].faces();
  const std::vector<std::int32_t>& fragment = system.bodies[body].fragments;
  const double usual = 2.0 * system.bodies[body].particle_half_size;
  search_.find(particle_places_[body], particle_places_[body], usual, [&](std::uint32_t k, std::uint32_t l) {
    const std::uint32_t i = faces[k], j = faces[l];
    if (i < j && fragment[i] != fragment[j])
      touch_as_circles(system, bodies, n, i, j, distance_of(body, i, j, usual));
  });
}

double Contact::distance_of(std::size_t body, std::uint32_t i, std::uint32_t j, double usual) const {
  const Rest key{static_cast<std::uint32_t>(body), i, j, 0.0};
  const auto rest = std::ranges::lower_bound(rests_, key);
  return rest != rests_.end() && rest->body == key.body && rest->i == i && rest->j == j ? rest->distance
                                                                                        : usual;
}

/// Particles i of the pair's first body and j of its second as circles that touch from `distance` on.
void Contact::touch_as_circles(const System& system, std::span<const Configuration> bodies, std::size_t n,
                               std::uint32_t i, std::uint32_t j, double distance) {
  const BodyPair& pair = pairs_[n];
  const Body &a = system.bodies[pair.a], &b = system.bodies[pair.b];
  // The particle's ring at the start is in its mass.
  const auto ring_of = [&](const Body& body, std::size_t which, std::uint32_t identity) {
    const double square = 4.0 * body.particle_half_size * body.particle_half_size;
    return body.particles.mass[place_[which][identity]] / (body.material->density() * square);
  };
  const double half_a = a.particle_half_size, half_b = b.particle_half_size,
               area = 2.0 * std::min(half_a, half_b) * std::min(ring_of(a, pair.a, i), ring_of(b, pair.b, j));
  const PairForce force =
      pair_force(place_of(bodies, pair.a, i), place_of(bodies, pair.b, j), distance, area, pair.law);
  if (!(force.energy > 0.0)) return;
  gaps_[n] = std::min(gaps_[n], force.gap);
  const auto arm = [&](double size) { return Vector{size * force.normal[0], size * force.normal[1]}; };
  const double from_a = (distance + force.gap) * half_a / (half_a + half_b);
  const TouchKey key{static_cast<std::uint32_t>(n), TouchKey::none, TouchKey::none, i, j};
  touch(bodies, {key, arm(from_a), arm(from_a - distance - force.gap), {}, force});
}

Grip Contact::grip_of(const TouchKey& key, const Spring& spring,
                      std::span<const Configuration> bodies) const {
  const BodyPair& pair = pairs_[key.pair];
  const Configuration &a = bodies[pair.a], &b = bodies[pair.b];
  const std::size_t i = place_[pair.a][key.carrier_a], j = place_[pair.b][key.carrier_b];
  return {key,          spring,    {b.position[0][j] - a.position[0][i], b.position[1][j] - a.position[1][i]},
          a.turn[i],    b.turn[j], a.mirrored[i],
          b.mirrored[j]};
}

/// How far b has slid along the surface over a where they touch, m: each carrier moves, and turns about
/// itself (by the chord, so that turning as one is no sliding).
double Contact::way(const Touch& t, const Grip& before, const Grip& now) const {
  const double turn_a = now.turn_a - before.turn_a, turn_b = now.turn_b - before.turn_b,
               mean = 0.5 * (turn_a + turn_b), rolling = 0.5 * (turn_b - turn_a);
  // The carriers' arms to the middle are apart by `apart`.
  const Vector arms{t.arm_a[0] + t.arm_b[0], t.arm_a[1] + t.arm_b[1]};
  Vector slid{};
  for (std::size_t c = 0; c < 2; ++c) {
    const std::size_t other = 1 - c;
    const double sign = c == 0 ? -1.0 : 1.0;
    const double chord = 0.5 * (before.apart[other] + now.apart[other]);
    slid[c] = now.apart[c] - before.apart[c] + sign * (rolling * arms[other] - mean * chord);
  }
  return slid[1] * t.force.normal[0] - slid[0] * t.force.normal[1];
}

/// Enters a touch, with its friction.
void Contact::touch(std::span<const Configuration> bodies, Touch&& t) {
  if (const double friction = pairs_[t.key.pair].friction; friction > 0.0) {
    const double bound = t.force.pressure > 0.0 ? friction * t.force.pressure : 0.0;
    const auto grip = std::ranges::lower_bound(grips_, t.key, {}, &Grip::key);
    const Grip now = grip_of(t.key, {}, bodies);
    if (grip == grips_.end() || grip->key != t.key)
      t.friction = {{0.0, t.force.grip}, 0.0, true};                    // no way from anywhere yet
    else if (grip->side_a != now.side_a || grip->side_b != now.side_b)  // a carrier has crossed the axis
      t.friction = {{0.0, t.force.grip}, grip->spring.energy(), true};
    else
      t.friction = stretch(grip->spring, t.force.grip, bound, way(t, *grip, now));
  }
  touches_.push_back(std::move(t));
}

void Contact::foresee_fragments(const System& system, std::size_t n, double margin,
                                std::vector<CarrierPair>& list) {
  const std::size_t body = pairs_[n].a;
  list_faces(configurations(system), body);
  const std::span<const std::uint32_t> faces = fragments_[body].faces();
  const std::vector<std::int32_t>& fragment = system.bodies[body].fragments;
  search_.find(particle_places_[body], particle_places_[body],
               2.0 * (system.bodies[body].particle_half_size + margin),
               [&](std::uint32_t k, std::uint32_t l) {
                 const std::uint32_t i = faces[k], j = faces[l];
                 if (i < j && fragment[i] != fragment[j]) list.push_back(carriers_of(n, i, j));
               });
}

std::vector<CarrierPair> Contact::foresee(const System& system, double margin) {
  std::vector<CarrierPair> list;
  for (std::size_t n = 0; n < pairs_.size(); ++n) {
    const BodyPair& pair = pairs_[n];
    if (pair.a == pair.b) {
      foresee_fragments(system, n, margin, list);
      continue;
    }
    search_.find(places_of(pair.a), places_of(pair.b), reach(pair) + 2.0 * margin,
                 [&](std::uint32_t i, std::uint32_t j) {
                   list.push_back(carriers_of(n, patches_[first_[pair.a] + i].carrier,
                                              patches_[first_[pair.b] + j].carrier));
                 });
  }
  for (const Touch& t : touches_)
    if (!t.key.of_patches() && pairs_[t.key.pair].a != pairs_[t.key.pair].b)
      list.push_back(carriers_of(t.key.pair, t.key.carrier_a, t.key.carrier_b));
  return list;
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

std::vector<double> Contact::state(const System& system) const {
  std::vector<double> values;
  const auto put = [&](const auto&... number) { (values.push_back(static_cast<double>(number)), ...); };
  for (const ContactHistory& h : history_) put(h.impulse[0], h.impulse[1], h.friction_work, h.least_gap);
  put(next_field_);
  for (std::size_t body = 0; body < fragments_.size(); ++body) {
    const std::vector<std::int32_t>& fragment = system.bodies[body].fragments;
    const std::vector<std::uint32_t> cut = fragments_[body].cut();
    put(cut.size(), fragment.size());
    values.insert(values.end(), cut.begin(), cut.end());
    values.insert(values.end(), fragment.begin(), fragment.end());
  }
  put(rests_.size());
  for (const Rest& rest : rests_) put(rest.body, rest.i, rest.j, rest.distance);
  put(grips_.size());
  for (const Grip& g : grips_)
    put(g.key.pair, g.key.patch_a, g.key.patch_b, g.key.carrier_a, g.key.carrier_b, g.spring.force,
        g.spring.stiffness);
  return values;
}

bool Contact::restore(System& system, std::span<const double> state) {
  bool fits = true;
  const auto take = [&] {
    fits = fits && !state.empty();
    if (!fits) return 0.0;
    const double value = state.front();
    state = state.subspan(1);
    return value;
  };
  // A count or an index below a bound.
  const auto below = [&](std::size_t bound) -> std::uint32_t {
    const double value = take();
    fits = fits && value >= 0.0 && value < static_cast<double>(bound);
    return fits ? static_cast<std::uint32_t>(value) : 0;
  };
  for (ContactHistory& h : history_) h = {{take(), take()}, take(), take()};
  constexpr std::size_t any = TouchKey::none;
  next_field_ = static_cast<std::int32_t>(below(any / 2));
  for (std::size_t body = 0; body < fragments_.size(); ++body) {
    std::vector<std::uint32_t> cut(below(state.size() + 1));
    const std::size_t size = below(state.size() + 1), particles = system.bodies[body].particles.size;
    for (std::uint32_t& identity : cut) identity = below(particles);
    std::vector<std::int32_t>& fragment = system.bodies[body].fragments;
    fits = fits && (size == 0 || size == particles);
    fragment.assign(fits ? size : 0, 0);
    for (std::int32_t& field : fragment) field = static_cast<std::int32_t>(below(any / 2));
    fragments_[body].restored(system.bodies[body], cut);
  }
  rests_.resize(below(state.size() + 1));
  for (Rest& rest : rests_) {
    const std::uint32_t body = below(place_.size());
    const std::size_t particles = place_[body].size();
    rest = {body, below(particles), below(particles), take()};
  }
  grips_.resize(below(state.size() + 1));
  for (Grip& grip : grips_) {
    const std::uint32_t pair = below(pairs_.size()), patch_a = below(std::size_t{any} + 1),
                        patch_b = below(std::size_t{any} + 1),
                        a = fits ? below(place_[pairs_[pair].a].size()) : 0,
                        b = fits ? below(place_[pairs_[pair].b].size()) : 0;
    const double force = take(), stiffness = take();
    grip = {{pair, patch_a, patch_b, a, b}, {force, stiffness}, {}, 0.0, 0.0, 0.0, 0.0};
  }
  if (!fits || !state.empty()) return false;
  system.grid_is_stale = true;
  found_ = false;
  settle(system);
  evaluated_ = true;
  return true;
}

}  // namespace vitrum::mpm
