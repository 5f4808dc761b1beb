#include "scene/build_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <thread>

#include "mpm/transfer.hpp"
#include "scene/input_error.hpp"
#include "scene/local_method.hpp"
#include "scene/perturbation.hpp"
#include "scene/seeding.hpp"

namespace vitrum {
namespace {

mpm::ShapeKind shape_kind(ShapeFunctions s) {
  switch (s) {
    case ShapeFunctions::linear:
      return mpm::ShapeKind::linear;
    case ShapeFunctions::gimp:
      return mpm::ShapeKind::gimp;
    case ShapeFunctions::bspline2:
      return mpm::ShapeKind::bspline2;
  }
  return mpm::ShapeKind::linear;
}

void allocate(Particles& p, const Material& material) {
  const auto sized = [&](auto& columns) {
    for (auto& column : columns) column.assign(p.size, 0.0);
  };
  sized(p.position), sized(p.velocity), sized(p.elastic_strain), sized(p.stress), sized(p.strain_increment);
  p.mass.assign(p.size, 0.0);
  p.spin_increment.assign(p.size, 0.0);
  p.identity.assign(p.size, 0);
  for (const VariableInfo& v : material.variables())
    p.variables[static_cast<std::size_t>(v.variable)].assign(p.size, 0.0);
}

Body make_body(const BodyDefinition& definition, std::shared_ptr<const Material> material,
               const Scene& scene) {
  const auto per_side = static_cast<int>(std::lround(std::sqrt(definition.particles_per_cell)));
  const bool axisymmetric = scene.geometry == Geometry::axisymmetric;
  // Particles are numbered with 32 bits; far beyond, seeding alone would not end.
  constexpr double most = 4.0e9;
  if (const double count = most_seeds(definition.shape, scene.cell, per_side); count > most)
    throw InputError(
        fmt::format("body '{}': its shape takes up to {:.3g} particles with cells of {} m and {} particles "
                    "per cell; expected at most {:g}",
                    definition.name, count, scene.cell, definition.particles_per_cell, most));
  constexpr double farthest = 2.0e9;  // cells: the grid counts them in 32 bits
  if (const double found = reach(definition.shape); !(found < farthest * scene.cell))
    throw InputError(fmt::format(
        "body '{}': its shape reaches {} m from an axis of coordinates; expected at most {:g} cells of {} m",
        definition.name, found, farthest, scene.cell));
  std::vector<Seed> seeds = seed_shape(definition.shape, scene.cell, per_side);
  // A disk about a point of the axis stands for a sphere: what lies at r <= 0 is its mirror image.
  if (axisymmetric) std::erase_if(seeds, [](const Seed& s) { return !(s.position[0] > 0.0); });
  if (seeds.empty())
    throw InputError(fmt::format(
        "body '{}': its shape holds no particle with cells of {} m and {} particles per cell; expected a "
        "larger shape or a smaller space.cell",
        definition.name, scene.cell, definition.particles_per_cell));
  Body body{definition.name, std::move(material), {}, 0.5 * scene.cell / per_side};
  Particles& p = body.particles;
  p.size = seeds.size();
  allocate(p, *body.material);
  const SymmetricTensor stress{definition.stress[0], definition.stress[1], definition.stress[2],
                               definition.stress[3]};
  const PointState state = body.material->initial_state(stress);
  const SymmetricTensor& e = state.elastic_strain;
  // Masses and velocities are those of the places before the shift: positions alone differ within an
  // ensemble.
  const std::vector<Vector2> shifts = displacements(definition.perturbation, scene.cell, p.size);
  const double density = body.material->parameters().elastic.density;
  for (std::size_t i = 0; i < p.size; ++i) {
    const Vector2& x = seeds[i].position;
    if (axisymmetric && !(x[0] + shifts[i][0] > 0.0))
      throw InputError(fmt::format(
          "body '{}': its perturbation moves a particle from r = {} m beyond the axis; expected a "
          "smaller amplitude",
          definition.name, x[0]));
    const auto& G = definition.velocity_gradient;
    for (std::size_t k = 0; k < 2; ++k) {
      p.position[k][i] = x[k] + shifts[i][k];
      p.velocity[k][i] = definition.velocity[k] + G[k][0] * x[0] + G[k][1] * x[1];
    }
    p.mass[i] = density * seeds[i].area * (axisymmetric ? x[0] : 1.0);
    const std::array<double, 4> strains{e.rr, e.zz, e.tt, e.rz},
        stresses{stress.rr, stress.zz, stress.tt, stress.rz};
    for (std::size_t k = 0; k < 4; ++k) p.elastic_strain[k][i] = strains[k], p.stress[k][i] = stresses[k];
    p.identity[i] = static_cast<std::uint32_t>(i);
  }
  return body;
}

}  // namespace

int threads_for(std::size_t particles, int available) {
  constexpr std::size_t worth_a_thread = 5000;
  const auto useful = static_cast<int>(std::min<std::size_t>(particles / worth_a_thread + 1, 1024));
  return std::max(1, std::min(useful, available));
}

System build_system(const Scene& scene, int threads) {
  System system;
  system.axisymmetric = scene.geometry == Geometry::axisymmetric;
  system.cell = scene.cell;
  system.gravity = scene.gravity;
  system.time = scene.start;
  for (const BodyDefinition& definition : scene.bodies) {
    const auto named =
        std::find_if(scene.materials.begin(), scene.materials.end(),
                     [&](const MaterialParameters& m) { return m.name == definition.material; });
    system.bodies.push_back(make_body(definition, make_material(*named, scene.cell), scene));
  }
  std::vector<mpm::Boundary> boundaries;
  for (const BoundaryDefinition& b : scene.boundaries)
    boundaries.push_back({b.box.min, b.box.max, b.fixed, b.velocity});
  system.grid =
      mpm::Grid(scene.cell, shape_kind(scene.shape_functions), system.axisymmetric, std::move(boundaries));
  system.local = make_local_integrator(scene.constitutive);
  const int available =
      threads > 0 ? threads : static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  system.team = std::make_unique<mpm::ThreadTeam>(
      threads > 0 ? threads : threads_for(system.particle_count(), available));
  system.record.kinetic = mpm::kinetic_energy(system);
  return system;
}

}  // namespace vitrum
