#include <algorithm>
#include <cmath>

#include "mpm/contact/contact.hpp"

// What touches: patches of two bodies, particles that cracks have laid open, faces of fragments.

namespace vitrum::mpm {

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
      if (has_left(system, pair.a, patches_[first_[pair.a] + i].carrier) ||
          has_left(system, pair.b, patches_[first_[pair.b] + j].carrier))
        return;
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
  if (has_left(system, pair.a, i) || has_left(system, pair.b, j)) return;
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
  search_.find(
      particle_places_[body], particle_places_[body], 2.0 * (system.bodies[body].particle_half_size + margin),
      [&](std::uint32_t k, std::uint32_t l) {
        const std::uint32_t i = faces[k], j = faces[l];
        if (i < j && fragment[i] != fragment[j] && !has_left(system, body, i) && !has_left(system, body, j))
          list.push_back(carriers_of(n, i, j));
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
                   const std::uint32_t a = patches_[first_[pair.a] + i].carrier,
                                       b = patches_[first_[pair.b] + j].carrier;
                   if (!has_left(system, pair.a, a) && !has_left(system, pair.b, b))
                     list.push_back(carriers_of(n, a, b));
                 });
  }
  for (const Touch& t : touches_)
    if (!t.key.of_patches() && pairs_[t.key.pair].a != pairs_[t.key.pair].b)
      list.push_back(carriers_of(t.key.pair, t.key.carrier_a, t.key.carrier_b));
  return list;
}

}  // namespace vitrum::mpm
