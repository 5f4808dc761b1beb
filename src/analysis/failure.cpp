#include "analysis/failure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/fragments.hpp"

namespace vitrum {
namespace {

const std::vector<double>& column(const Body& body, Variable v) {
  return body.particles.variables[static_cast<std::size_t>(v)];
}

double damage_of(const Body& body, std::size_t i) {
  PointState s;
  s.crack_density = column(body, Variable::crack_density)[i];
  return body.material->damage(s);
}

std::array<double, 2> mean_velocity(const Body& body) {
  std::array<double, 2> momentum{};
  double mass = 0.0;
  const Particles& p = body.particles;
  for (std::size_t i = 0; i < p.size; ++i) {
    mass += p.mass[i];
    for (std::size_t k = 0; k < 2; ++k) momentum[k] += p.mass[i] * p.velocity[k][i];
  }
  return {momentum[0] / mass, momentum[1] / mass};
}

}  // namespace

FailureAnalysis::FailureAnalysis(const System& system) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  double fastest = 0.0;
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    const Body& body = system.bodies[n];
    Extent e{{infinite, infinite}, {-infinite, -infinite}};
    for (std::size_t k = 0; k < 2; ++k)
      for (const double x : body.particles.position[k])
        e.min[k] = std::min(e.min[k], x - body.particle_half_size), e.max[k] = std::max(e.max[k], x + body.particle_half_size);
    extents_.push_back(e);
    // The projectile is the fastest body; the target is the first body that can separate and that is not the projectile.
    const std::array<double, 2> v = mean_velocity(body);
    const double speed = std::hypot(v[0], v[1]);
    if (speed > fastest) {
      fastest = speed;
      projectile_ = n;
      direction_ = std::abs(v[1]) >= std::abs(v[0]) ? 1 : 0;
      sense_ = v[direction_] < 0.0 ? -1.0 : 1.0;
    }
  }
  for (std::size_t n = 0; n < system.bodies.size() && !target_; ++n)
    if (n != projectile_ && system.bodies[n].material->parameters().decohesion) target_ = n;
}

void FailureAnalysis::observe(const System& system, double step) {
  for (const BodyEvent& e : system.record.events) {
    std::optional<FirstEvent>* first = e.event.kind == EventKind::localisation ? &memory_.localisation
                                       : e.event.kind == EventKind::separation ? &memory_.separation
                                                                               : nullptr;
    if (first == nullptr) continue;
    const double time = system.time - step * (1.0 - e.event.fraction);
    if (*first && (*first)->time <= time) continue;
    const Particles& p = system.bodies[e.body].particles;
    *first = FirstEvent{time, p.position[0][e.particle], p.position[1][e.particle], system.bodies[e.body].name};
  }
  if (memory_.damage) return;
  for (const Body& body : system.bodies) {
    if (column(body, Variable::crack_density).empty()) continue;
    for (std::size_t i = 0; i < body.particles.size; ++i)
      if (column(body, Variable::crack_density)[i] > 0.0 && damage_of(body, i) > damaged) {
        memory_.damage = FirstEvent{system.time, body.particles.position[0][i], body.particles.position[1][i], body.name};
        return;
      }
  }
}

FailureReport FailureAnalysis::report(const System& system, bool with_fragments) const {
  FailureReport r;
  r.first_damage = memory_.damage;
  r.first_localisation = memory_.localisation;
  r.first_separation = memory_.separation;
  const auto raise = [](std::optional<double>& to, double value) { to = to ? std::max(*to, value) : value; };
  for (const Body& body : system.bodies) {
    const Particles& p = body.particles;
    const auto &length = column(body, Variable::effective_length), &decohesion = column(body, Variable::decohesion);
    const auto &opening_n = column(body, Variable::opening_n), &opening_t = column(body, Variable::opening_t);
    for (std::size_t i = 0; i < length.size(); ++i) {
      if (!(length[i] > 0.0)) continue;
      const double radius = std::abs(p.position[0][i]), opening = std::hypot(opening_n[i], opening_t[i]);
      ++r.localised;
      if (decohesion[i] >= 1.0) ++r.separated;
      raise(r.localised_radius_max, radius);
      if (!r.max_opening || opening > *r.max_opening) r.max_opening = opening, r.max_opening_radius = radius;
    }
    if (!column(body, Variable::crack_density).empty())
      for (std::size_t i = 0; i < p.size; ++i)
        if (damage_of(body, i) > damage_front) raise(r.damage_front_radius, std::abs(p.position[0][i]));
  }
  if (!with_fragments) return r;
  const std::vector<ConnectedPiece> pieces = connected_pieces(system);
  r.fragments = fragments(system, pieces);
  for (const ConnectedPiece& piece : pieces)
    if (piece.body == target_) {
      r.perforated = perforated(system, piece.particles);
      break;
    }
  return r;
}

/// The projectile's front has passed the target's original far face by a cell, and the target's largest piece no longer reaches
/// into the column that the projectile came along.
std::optional<bool> FailureAnalysis::perforated(const System& system, const std::vector<std::size_t>& main_piece) const {
  if (!projectile_ || !target_) return std::nullopt;
  const std::size_t along = direction_, across = 1 - direction_;
  const Extent &target = extents_[*target_], &projectile = extents_[*projectile_];
  const double far_face = sense_ < 0.0 ? target.min[along] : target.max[along];
  double front = -std::numeric_limits<double>::infinity();
  for (const double x : system.bodies[*projectile_].particles.position[along]) front = std::max(front, sense_ * (x - far_face));
  if (front < system.cell) return false;
  const auto& x = system.bodies[*target_].particles.position[across];
  return std::none_of(main_piece.begin(), main_piece.end(), [&](std::size_t i) {
    return x[i] > projectile.min[across] + system.cell * 0.5 && x[i] < projectile.max[across] - system.cell * 0.5;
  });
}

}  // namespace vitrum
