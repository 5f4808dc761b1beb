#include "scene/build_contact.hpp"

#include <algorithm>
#include <cmath>

#include "mpm/contact/contact.hpp"
#include "scene/surface_patches.hpp"

namespace vitrum {
namespace {

double friction_between(const Scene& scene, std::size_t a, std::size_t b) {
  const std::array<std::string, 2> names{scene.bodies[a].name, scene.bodies[b].name};
  for (const ContactPair& pair : scene.contact.pairs)
    if (pair.bodies == names || (pair.bodies[0] == names[1] && pair.bodies[1] == names[0]))
      return pair.friction;
  return scene.contact.friction;
}

/// Whether cracks may open faces.
bool may_break(const Body& body) {
  return body.material->column("decohesion").has_value();
}

/// rho c^2, Pa: pressure per strain in a plane wave.
double wave_modulus(const Body& body) {
  const double c = body.material->wave_speed();
  return body.material->density() * c * c;
}

/// The pressure of a penetration by one cell is that of two materials in series strained by 2 over it.
double stiffness_between(const Scene& scene, const Body& a, const Body& b) {
  const double of_a = wave_modulus(a), of_b = wave_modulus(b);
  return scene.contact.stiffness * 2.0 * of_a * of_b / (of_a + of_b) / scene.cell;
}

/// Largest speed of one body's particles against another's centre of mass, at the start, m/s.
double speed_against(const Body& body, const Body& other) {
  const Particles &p = body.particles, &q = other.particles;
  std::array<double, 2> mean{};
  double mass = 0.0, fastest = 0.0;
  for (std::size_t i = 0; i < q.size; ++i) {
    mass += q.mass[i];
    for (std::size_t k = 0; k < 2; ++k) mean[k] += q.mass[i] * q.velocity[k][i];
  }
  for (std::size_t i = 0; i < p.size; ++i)
    fastest =
        std::max(fastest, std::hypot(p.velocity[0][i] - mean[0] / mass, p.velocity[1][i] - mean[1] / mass));
  return fastest;
}

/// Penetration at which a surface gives way, m. Unless it is stated, half of it bears twice the pressure v
/// Z_a Z_b / (Z_a + Z_b) of plane waves (Z = rho c) that the meeting of two bodies starts: with less, bodies
/// pass through each other.
double depth_between(const Scene& scene, const Body& a, const Body& b, double stiffness) {
  constexpr double least = 0.5, most = 1.0;  // cells; deeper, thin bodies would feel each other's far sides
  if (scene.contact.depth) return *scene.contact.depth * scene.cell;
  const auto impedance = [](const Body& body) {
    return body.material->density() * body.material->wave_speed();
  };
  const double speed = std::max(speed_against(a, b), speed_against(b, a)), of_a = impedance(a),
               of_b = impedance(b);
  const double bears = 2.0 * 2.0 * speed * of_a * of_b / ((of_a + of_b) * stiffness);
  return std::clamp(bears, least * scene.cell, most * scene.cell);
}

}  // namespace

void build_contact(const Scene& scene, System& system) {
  if (scene.contact.method == ContactMethod::single) return;
  const bool in_pieces = scene.contact.self && std::ranges::any_of(system.bodies, may_break);
  if (system.bodies.size() < 2 && !in_pieces) return;
  std::vector<mpm::BodyPair> pairs;
  std::vector<std::vector<mpm::Patch>> patches;
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    system.bodies[b].field = static_cast<std::int32_t>(b);
    patches.push_back(surface_patches(scene.bodies[b], scene.geometry, system.bodies[b]));
    for (std::size_t a = 0; a <= b; ++a) {
      const Body &one = system.bodies[a], &other = system.bodies[b];
      if (a == b && !(in_pieces && may_break(other))) continue;
      const double stiffness = stiffness_between(scene, one, other);
      pairs.push_back({a,
                       b,
                       {stiffness, depth_between(scene, one, other, stiffness)},
                       friction_between(scene, a, b),
                       may_break(one) || may_break(other)});
    }
  }
  system.contact = std::make_shared<mpm::Contact>(system, std::move(pairs), patches);
}

}  // namespace vitrum
