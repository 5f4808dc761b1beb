#include "scene/build_contact.hpp"

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

}  // namespace

void build_contact(const Scene& scene, System& system) {
  if (scene.contact.method == ContactMethod::single || system.bodies.size() < 2) return;
  std::vector<mpm::BodyPair> pairs;
  std::vector<std::vector<mpm::Patch>> patches;
  for (std::size_t b = 0; b < system.bodies.size(); ++b) {
    system.bodies[b].field = static_cast<std::int32_t>(b);
    patches.push_back(surface_patches(scene.bodies[b].shape, scene.geometry, system.bodies[b]));
    for (std::size_t a = 0; a < b; ++a)
      pairs.push_back(
          {a,
           b,
           {stiffness_between(scene, system.bodies[a], system.bodies[b]), scene.contact.depth * scene.cell},
           friction_between(scene, a, b),
           may_break(system.bodies[a]) || may_break(system.bodies[b])});
  }
  system.contact = std::make_shared<mpm::Contact>(system, std::move(pairs), patches);
}

}  // namespace vitrum
