#include "observe/probes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "mpm/stress.hpp"
#include "observe/registry.hpp"

namespace vitrum {
namespace {

/// The particle nearest to a point; of equally near ones the first made.
std::uint32_t nearest(const Particles& p, const Vector2& point, double& farthest) {
  double least = std::numeric_limits<double>::infinity();
  std::uint32_t found = 0;
  for (std::size_t i = 0; i < p.size; ++i) {
    const double distance = std::hypot(p.position[0][i] - point[0], p.position[1][i] - point[1]);
    if (distance < least || (distance == least && p.identity[i] < found))
      least = distance, found = p.identity[i];
  }
  farthest = std::max(farthest, least);
  return found;
}

/// Where each identity is stored.
std::vector<std::uint32_t> places_of(const Particles& p) {
  std::vector<std::uint32_t> place(p.size);
  for (std::uint32_t i = 0; i < p.size; ++i) place[p.identity[i]] = i;
  return place;
}

}  // namespace

std::size_t body_of(const ProbeDefinition& probe, const System& system) {
  return static_cast<std::size_t>(std::ranges::find(system.bodies, probe.body, &Body::name) -
                                  system.bodies.begin());
}

Probed find_probed(const ProbeDefinition& probe, const Body& body) {
  const Particles& p = body.particles;
  Probed found;
  if (const auto* box = std::get_if<Box>(&probe.place)) {
    for (std::size_t i = 0; i < p.size; ++i) {
      const auto is_between = [&](std::size_t k) {
        return box->min[k] <= p.position[k][i] && p.position[k][i] <= box->max[k];
      };
      if (is_between(0) && is_between(1)) found.particles.push_back(p.identity[i]);
    }
    std::ranges::sort(found.particles);
    return found;
  }
  for (const Vector2& point : probe.points()) found.particles.push_back(nearest(p, point, found.farthest));
  return found;
}

std::unique_ptr<Observer> ProbeHistory::make(const Scene& scene, const System& system) {
  if (scene.probes.empty()) return nullptr;
  auto history = std::make_unique<ProbeHistory>();
  history->table_.cadence = history_cadence(scene);
  for (const ProbeDefinition& probe : scene.probes) {
    const std::size_t body = body_of(probe, system);
    const std::vector<std::uint32_t> particles = find_probed(probe, system.bodies[body]).particles;
    if (std::holds_alternative<Box>(probe.place))
      history->rows_.push_back({probe.name, body, 0, particles});
    else
      for (std::size_t k = 0; k < particles.size(); ++k)
        history->rows_.push_back({probe.name, body, k, {particles[k]}});
  }
  return history;
}

void ProbeHistory::tell(const System& system) {
  for (std::size_t n = 0; n < system.bodies.size(); ++n) {
    if (std::ranges::find(rows_, n, &Row::body) == rows_.end()) continue;
    const std::vector<std::uint32_t> place = places_of(system.bodies[n].particles);
    const TensorColumns stress = mpm::stress_of(system.bodies[n]);
    for (const Row& row : rows_)
      if (row.body == n) tell_row(system, row, place, stress);
  }
}

void ProbeHistory::tell_row(const System& system, const Row& row, const std::vector<std::uint32_t>& place,
                            const TensorColumns& stress) {
  const Particles& p = system.bodies[row.body].particles;
  double mass = 0.0;
  std::array<double, 2> x{}, v{};
  std::array<double, 4> s{}, e{};
  for (const std::uint32_t identity : row.particles) mass += p.mass[place[identity]];
  for (const std::uint32_t identity : row.particles) {
    const std::size_t i = place[identity];
    const double part = p.mass[i] / mass;  // of the volume as well: a body has one density
    for (std::size_t k = 0; k < 2; ++k) x[k] += part * p.position[k][i], v[k] += part * p.velocity[k][i];
    for (std::size_t k = 0; k < 4; ++k) s[k] += part * stress[k][i], e[k] += part * p.elastic_strain[k][i];
  }
  table_.row(system.time, row.probe, x[0], x[1], v[0], v[1], s[0], s[1], s[2], s[3], e[0], e[1], e[2], e[3],
             row.point, row.particles.size(), whole_body(system) * mass);
}

}  // namespace vitrum
