#include "observe/failure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numbers>
#include <numeric>

#include "materials/root.hpp"
#include "observe/fragments.hpp"

namespace vitrum {
namespace {

/// Value of the column that damage grows with beyond which it exceeds `damage`.
double value_at(const Material& material, double damage) {
  const double most = material.columns()[*material.damage_column()].bounds.highest;
  return first_reached(0.0, most, [&](double value) { return material.damage(value) > damage; });
}

/// That column of a body's particles; empty without damage.
const std::vector<double>& damage_column(const Body& body) {
  static const std::vector<double> none;
  const std::optional<std::size_t> k = body.material->damage_column();
  return k ? body.particles.variables[*k] : none;
}

double largest(const std::vector<double>& values) {
  double most = 0.0;
#pragma omp simd reduction(max : most)
  for (std::size_t i = 0; i < values.size(); ++i) most = std::max(most, values[i]);
  return most;
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

Failed failed_part(const Body& body, double whole) {
  Failed failed;
  const auto &length = body.column("effective_length"), &decohesion = body.column("decohesion");
  for (std::size_t i = 0; i < length.size(); ++i) {
    if (!(length[i] > 0.0)) continue;
    const double volume = whole * body.particles.mass[i] / body.material->density();
    ++failed.localised, failed.volume += volume, failed.crack_area += volume / length[i];
    if (decohesion[i] >= 1.0) ++failed.separated;
  }
  return failed;
}

namespace {

/// Counts, areas, fronts and openings of a body; `first_*` are left to the caller.
FailureMeasures measure(const Body& body, double whole) {
  FailureMeasures m;
  const Failed failed = failed_part(body, whole);
  m.localised = failed.localised, m.separated = failed.separated;
  m.crack_area = failed.crack_area, m.localised_volume = failed.volume;
  const auto raise = [](std::optional<double>& to, double value) { to = to ? std::max(*to, value) : value; };
  const Particles& p = body.particles;
  const auto& length = body.column("effective_length");
  const auto &opening_n = body.column("opening_n"), &opening_t = body.column("opening_t");
  for (std::size_t i = 0; i < length.size(); ++i) {
    if (!(length[i] > 0.0)) continue;
    const double radius = std::abs(p.position[0][i]), opening = std::hypot(opening_n[i], opening_t[i]);
    raise(m.localised_radius_max, radius);
    if (!m.max_opening || opening > *m.max_opening) m.max_opening = opening, m.max_opening_radius = radius;
  }
  const std::vector<double>& damaged = damage_column(body);
  for (std::size_t i = 0; i < damaged.size(); ++i)
    if (body.material->damage(damaged[i]) > damage_front_threshold)
      raise(m.damage_front_radius, std::abs(p.position[0][i]));
  return m;
}

/// Enters one body's measures into those of all.
void merge(FailureMeasures& all, const FailureMeasures& one) {
  for (std::optional<FirstEvent> FailureMeasures::*first :
       {&FailureMeasures::first_damage, &FailureMeasures::first_localisation,
        &FailureMeasures::first_separation})
    if (one.*first && (!(all.*first) || (one.*first)->time < (all.*first)->time)) all.*first = one.*first;
  all.localised += one.localised;
  all.separated += one.separated;
  all.crack_area += one.crack_area, all.localised_volume += one.localised_volume;
  // An empty optional is less than any value.
  all.localised_radius_max = std::max(all.localised_radius_max, one.localised_radius_max);
  all.damage_front_radius = std::max(all.damage_front_radius, one.damage_front_radius);
  if (one.max_opening > all.max_opening)
    all.max_opening = one.max_opening, all.max_opening_radius = one.max_opening_radius;
}

}  // namespace

FailureAnalysis::FailureAnalysis(const System& system) : memory_(system.bodies.size()) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    const Body& body = system.bodies[n];
    Extent e{{infinite, infinite}, {-infinite, -infinite}};
    for (std::size_t k = 0; k < 2; ++k)
      for (const double x : body.particles.position[k])
        e.min[k] = std::min(e.min[k], x - body.particle_half_size),
        e.max[k] = std::max(e.max[k], x + body.particle_half_size);
    extents_.push_back(e);
    damaging_density_.push_back(body.material->damage_column() ? value_at(*body.material, damage_threshold)
                                                               : infinite);
  }
  choose_projectile(system);
}

/// The projectile is the fastest body that has a target: the first other body that can separate and that it
/// has not left behind.
void FailureAnalysis::choose_projectile(const System& system) {
  double fastest = 0.0;
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    const std::array<double, 2> v = mean_velocity(system.bodies[n]);
    const double speed = std::hypot(v[0], v[1]);
    if (!(speed > fastest)) continue;
    const std::size_t along = std::abs(v[1]) >= std::abs(v[0]) ? 1 : 0;
    const double sense = v[along] < 0.0 ? -1.0 : 1.0;
    for (std::size_t t = 0; t < system.bodies.size(); ++t) {
      const bool is_ahead = sense < 0.0 ? extents_[n].max[along] > extents_[t].min[along]
                                        : extents_[n].min[along] < extents_[t].max[along];
      if (t == n || !is_ahead || !separates(system.bodies[t])) continue;
      fastest = speed;
      projectile_ = n, target_ = t;
      direction_ = along, sense_ = sense;
      break;
    }
  }
}

void FailureAnalysis::step(const System& system, double duration) {
  for (const BodyEvent& e : system.record.events) {
    Memory& memory = memory_[e.body];
    std::optional<FirstEvent>* first = e.event.kind == EventKind::localisation ? &memory.localisation
                                       : e.event.kind == EventKind::separation ? &memory.separation
                                                                               : nullptr;
    if (first == nullptr) continue;
    const double time = system.time - duration * (1.0 - e.event.fraction);
    if (*first && (*first)->time <= time) continue;
    const Particles& p = system.bodies[e.body].particles;
    *first =
        FirstEvent{time, p.position[0][e.particle], p.position[1][e.particle], system.bodies[e.body].name};
  }
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    const Body& body = system.bodies[n];
    const std::vector<double>& density = damage_column(body);
    // All particles, every step, until one is damaged: by numbers, which is vectorised, not by the law.
    if (memory_[n].damage || largest(density) < damaging_density_[n]) continue;
    const auto first = std::find_if(density.begin(), density.end(),
                                    [&](double value) { return value >= damaging_density_[n]; });
    const auto i = static_cast<std::size_t>(first - density.begin());
    memory_[n].damage =
        FirstEvent{system.time, body.particles.position[0][i], body.particles.position[1][i], body.name};
  }
}

struct FailureAnalysis::NamedEvent {
  const char* name;
  std::optional<FirstEvent> Memory::*member;
};
const std::array<FailureAnalysis::NamedEvent, 3> FailureAnalysis::named_events{
    {{"damage", &Memory::damage},
     {"localisation", &Memory::localisation},
     {"separation", &Memory::separation}}};

namespace {

std::string name_of(const char* event, std::size_t body) {
  return fmt::format("failure.first_{}.{}", event, body);
}

}  // namespace

void FailureAnalysis::save(Archive& archive) const {
  for (std::size_t n = 0; n < memory_.size(); ++n)
    for (const auto& [name, member] : named_events)
      if (const std::optional<FirstEvent>& first = memory_[n].*member) {
        archive.put(name_of(name, n), {first->time, first->r, first->z});
        archive.put_text(name_of(name, n), first->body);
      }
}

void FailureAnalysis::restore(const Archive& archive) {
  for (std::size_t n = 0; n < memory_.size(); ++n)
    for (const auto& [name, member] : named_events) {
      if (!archive.has(name_of(name, n))) continue;
      const std::vector<double>& at = archive.numbers(name_of(name, n), 3);
      memory_[n].*member = FirstEvent{at[0], at[1], at[2], archive.text(name_of(name, n))};
    }
}

void FailureAnalysis::declare(const System& system, std::vector<Quantity>& quantities) const {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  const FailureReport f = report(system, false);
  const Quantity own[] = {{"localised", "1", "localised particles", static_cast<double>(f.localised)},
                          {"separated", "1", "separated particles", static_cast<double>(f.separated)},
                          {"crack_area", system.axisymmetric ? "m^2" : "m",
                           "area of cracks, localised or separated: sum of V0/L_e", f.crack_area},
                          {"localised_volume", system.axisymmetric ? "m^3" : "m^2",
                           "volume of the localised particles", f.localised_volume},
                          {"localised_radius_max", "m", "largest r (|x|) of a localised particle; NaN: none",
                           f.localised_radius_max.value_or(none)},
                          {"damage_front_radius", "m", "largest r (|x|) with damage above 0.1; NaN: none",
                           f.damage_front_radius.value_or(none)},
                          {"max_opening", "m", "largest opening; NaN: none", f.max_opening.value_or(none)}};
  quantities.insert(quantities.end(), std::begin(own), std::end(own));
}

FailureReport FailureAnalysis::report(const System& system, bool with_fragments) const {
  FailureReport r;
  const double whole = system.axisymmetric ? 2.0 * std::numbers::pi : 1.0;
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    FailureMeasures m = measure(system.bodies[n], whole);
    m.first_damage = memory_[n].damage;
    m.first_localisation = memory_[n].localisation;
    m.first_separation = memory_[n].separation;
    merge(r, m);
    r.bodies.push_back(std::move(m));
  }
  if (!with_fragments) return r;
  const std::vector<ConnectedPiece> pieces = connected_pieces(system);
  r.fragments = fragments(system, pieces);
  r.perforated = perforated(system, pieces);
  return r;
}

/// A tenth of the projectile has passed the target's original far face by a cell (not just a splinter of it),
/// and the target's largest piece no longer reaches into the column that the projectile came along, or has
/// less than a tenth of the target's mass: it is debris, then, and bars nothing.
std::optional<bool> FailureAnalysis::perforated(const System& system,
                                                const std::vector<ConnectedPiece>& pieces) const {
  if (!projectile_ || !target_) return std::nullopt;
  const std::size_t along = direction_, across = 1 - direction_;
  constexpr double substantial = 0.1;  // of a body's mass
  const Extent &target = extents_[*target_], &extent = extents_[*projectile_];
  const double far_face = sense_ < 0.0 ? target.min[along] : target.max[along];
  const Particles& projectile = system.bodies[*projectile_].particles;
  double mass = 0.0, beyond = 0.0;
  for (std::size_t i = 0; i < projectile.size; ++i) {
    mass += projectile.mass[i];
    if (sense_ * (projectile.position[along][i] - far_face) > system.cell) beyond += projectile.mass[i];
  }
  if (beyond < substantial * mass) return false;
  const Particles& p = system.bodies[*target_].particles;
  const auto in_the_way = [&](std::size_t i) {
    const double x = p.position[across][i];
    return x > extent.min[across] + system.cell * 0.5 && x < extent.max[across] - system.cell * 0.5;
  };
  const double all = std::accumulate(p.mass.begin(), p.mass.end(), 0.0);
  const auto largest = std::ranges::find(pieces, *target_, &ConnectedPiece::body);
  if (largest == pieces.end()) return true;
  double left = 0.0;
  for (const std::size_t i : largest->particles) left += p.mass[i];
  return left < substantial * all || std::ranges::none_of(largest->particles, in_the_way);
}

}  // namespace vitrum
