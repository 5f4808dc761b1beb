#include "scene/build_system.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <system_error>

#include "integrators/grid/relaxation.hpp"
#include "integrators/local/local_method.hpp"
#include "mpm/computation_error.hpp"
#include "mpm/contact/contact.hpp"
#include "mpm/domain.hpp"
#include "mpm/loads.hpp"
#include "mpm/point.hpp"
#include "mpm/transfer.hpp"
#include "scene/build_contact.hpp"
#include "scene/build_tractions.hpp"
#include "scene/choices.hpp"
#include "scene/input_error.hpp"
#include "scene/load_functions.hpp"
#include "scene/number_range.hpp"
#include "scene/perturbation.hpp"
#include "scene/seeding.hpp"
#include "scene/thread_count.hpp"

namespace vitrum {
namespace {

void allocate(Particles& p, const Material& material) {
  const auto sized = [&](auto& columns) {
    for (auto& column : columns) column.assign(p.size, 0.0);
  };
  sized(p.position), sized(p.velocity), sized(p.elastic_strain);
  p.mass.assign(p.size, 0.0);
  p.identity.assign(p.size, 0);
  p.keep_variables(material.columns());
}

/// Velocities and stresses that vary over place.
class PlaceFunctions {
 public:
  PlaceFunctions(const Scene& scene, std::size_t body) {
    for (std::size_t c = 0; c < 2; ++c)
      velocity_[c] = load_function(scene, fmt::format("body.{}.velocity.{}", body, c));
    for (std::size_t c = 0; c < 4; ++c)
      stress_[c] = load_function(scene, fmt::format("body.{}.stress.{}", body, c));
  }
  double velocity(std::size_t c, const Vector2& x, double constant) const {
    return velocity_[c] ? value(*velocity_[c], x) : constant;
  }
  bool has_stress() const {
    return std::ranges::any_of(stress_, [](const auto& function) { return function != nullptr; });
  }
  SymmetricTensor stress(const Vector2& x, std::array<double, 4> s) const {
    for (std::size_t c = 0; c < 4; ++c)
      if (stress_[c]) s[c] = value(*stress_[c], x);
    return {s[0], s[1], s[2], s[3]};
  }

 private:
  static double value(const mpm::LoadFunction& function, const Vector2& x) {
    try {
      return function.at(0.0, x);
    } catch (const ComputationError& error) {  // nothing has been computed yet
      throw InputError(error.what());
    }
  }
  std::array<std::shared_ptr<const mpm::LoadFunction>, 2> velocity_;
  std::array<std::shared_ptr<const mpm::LoadFunction>, 4> stress_;
};

Body make_body(const Scene& scene, std::size_t index, std::shared_ptr<const Material> material) {
  const BodyDefinition& definition = scene.bodies[index];
  const std::string place =
      fmt::format("{}: body '{}'",
                  scene.at(fmt::format("body.{}.{}", index, scene::shape_names[definition.shape.index()])),
                  definition.name);
  const auto per_side = static_cast<int>(std::lround(std::sqrt(definition.particles_per_cell)));
  const bool axisymmetric = scene.geometry == Geometry::axisymmetric;
  // Particles are numbered with 32 bits; far beyond, seeding alone would not end.
  constexpr double most = 4.0e9;
  if (const double count = most_seeds(definition, scene.cell, per_side); count > most)
    throw InputError(
        fmt::format("{}: its shape takes up to {:.3g} particles with cells of {} m and {} particles "
                    "per cell; expected at most {:g}",
                    place, count, scene.cell, definition.particles_per_cell, most));
  // The grid counts cells in 32 bits; products of lengths must not overflow.
  const double farthest = std::min(2.0e9 * scene.cell, 1.0e100);
  if (const double found = reach(definition); !(found < farthest))
    throw InputError(
        fmt::format("{}: its shape reaches {:g} m from an axis of coordinates; expected less than {:g} m",
                    place, found, farthest));
  const std::vector<Seed> seeds = seed_shape(definition, scene.cell, per_side, scene.geometry);
  if (seeds.empty())
    throw InputError(
        fmt::format("{}: its shape is smaller than a quarter of a particle's square with cells of {} m "
                    "and {} particles "
                    "per cell; expected a larger shape or a smaller space.cell",
                    place, scene.cell, definition.particles_per_cell));
  Body body{definition.name, std::move(material), {}, 0.5 * scene.cell / per_side};
  Particles& p = body.particles;
  p.size = seeds.size();
  allocate(p, *body.material);
  const PlaceFunctions over_place(scene, index);
  const std::array<double, 4>& stress = definition.stress;
  PointState state = body.material->start({stress[0], stress[1], stress[2], stress[3]});
  // Masses and velocities are those of the places before the shift: positions alone differ within an
  // ensemble.
  const std::vector<Vector2> shifts =
      displacements(definition.perturbation.value_or(Perturbation{}), scene.cell, p.size);
  const double density = body.material->density();
  const StrengthScatter* scatter = body.material->scatter();
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
      p.velocity[k][i] = over_place.velocity(k, x, definition.velocity[k]) + G[k][0] * x[0] + G[k][1] * x[1];
    }
    p.mass[i] = density * seeds[i].area * (axisymmetric ? x[0] : 1.0);
    if (over_place.has_stress()) state = body.material->start(over_place.stress(x, stress));
    if (scatter != nullptr) {
      constexpr double whole = 2.0 * std::numbers::pi;  // what the scene holds a radian of
      const double volume = seeds[i].area * (axisymmetric ? whole * x[0] : 1.0);
      state.variables[*body.material->column(StrengthScatter::column)] =
          draw_strength_factor(*scatter, volume, index, i);
    }
    mpm::put_point(state, body, i);
    p.identity[i] = static_cast<std::uint32_t>(i);
  }
  require_range(scene, index, body);
  return body;
}

/// Whether the faces of a boundary are planes of symmetry: it holds the component across them at 0 and
/// leaves the other free, and no particle stands behind its rows of nodes (its box may reach up to a cell
/// further). driven: its velocity varies.
bool mirrors(const BoundaryDefinition& boundary, bool driven, const System& system) {
  const std::size_t across = boundary.fixed[0] ? 0 : 1;
  if (boundary.fixed[1 - across] || boundary.velocity[across] != 0.0 || driven) return false;
  const double slack = 1e-9 * system.cell;
  Box held = boundary.box;
  const mpm::Rows rows = mpm::rows_between(held.min[across], held.max[across], system.cell);
  held.min[across] = rows.first * system.cell, held.max[across] = rows.last * system.cell;
  const auto within = [&](const Particles& p, std::size_t i) {
    bool inside = true;
    for (std::size_t c = 0; c < 2; ++c)
      inside = inside && p.position[c][i] > held.min[c] + slack && p.position[c][i] < held.max[c] - slack;
    return inside;
  };
  for (const Body& body : system.bodies)
    for (std::size_t i = 0; i < body.particles.size; ++i)
      if (within(body.particles, i)) return false;
  return true;
}

std::vector<mpm::Boundary> make_boundaries(const Scene& scene, const System& system) {
  std::vector<mpm::Boundary> list;
  // Boundaries of the same formula do not contradict each other.
  std::map<std::string, std::shared_ptr<const mpm::LoadFunction>> velocities;  // by formula
  for (std::size_t n = 0; n < scene.boundaries.size(); ++n) {
    const BoundaryDefinition& b = scene.boundaries[n];
    const std::string path = fmt::format("boundary.{}.velocity", n);
    list.push_back({b.name, b.box.min, b.box.max, b.fixed, b.velocity, b.moves, scene.start, b.priority,
                    mirrors(b, scene.varies(path), system)});
    for (std::size_t c = 0; c < 2; ++c) {
      const std::string at = fmt::format("{}.{}", path, c);
      const schema::Function* function = scene.function(at);
      if (function == nullptr) continue;
      std::shared_ptr<const mpm::LoadFunction> own;
      auto& velocity = function->formula.empty() ? own : velocities[function->formula];
      if (!velocity) velocity = load_function(scene, at);
      list.back().drive[c] =
          std::make_shared<mpm::Drive>(mpm::drive_of(velocity, b.moves, scene.start, scene.end, scene.cell));
    }
  }
  return list;
}

void relax_bodies(const Scene& scene, System& system) {
  std::vector<bool> relaxed;
  for (const BodyDefinition& body : scene.bodies) relaxed.push_back(body.relax);
  if (std::ranges::find(relaxed, true) == relaxed.end()) return;
  relax(system, relaxed);
  if (system.contact) system.contact->settle(system);
}

std::unique_ptr<parallel::ThreadTeam> make_team(int threads) {
  try {
    return std::make_unique<parallel::ThreadTeam>(threads);
  } catch (const std::system_error& error) {
    throw ComputationError(fmt::format("{} threads cannot be started: {}; ask for fewer (--threads)", threads,
                                       error.code().message()));
  }
}

}  // namespace

System build_system(const Scene& scene, int threads) {
  System system;
  system.axisymmetric = scene.geometry == Geometry::axisymmetric;
  system.cell = scene.cell;
  system.gravity = scene.gravity;
  for (std::size_t c = 0; c < 2; ++c)
    system.gravity_over_time[c] = load_function(scene, fmt::format("gravity.acceleration.{}", c));
  system.time = scene.start;
  for (std::size_t index = 0; index < scene.bodies.size(); ++index)
    system.bodies.push_back(make_body(scene, index, make_material(scene.material_of(index), scene.cell)));
  system.between_centroids = scene.gradients == Gradients::centroids;
  system.filters = scene.filter == Filter::pressures;
  system.flip = scene.flip;
  system.grid =
      mpm::Grid(scene.cell, scene.shape_functions, system.axisymmetric, make_boundaries(scene, system));
  if (scene.shape_functions == mpm::ShapeKind::cpgimp) mpm::keep_domains(system);
  mpm::set_loads(system, system.time, system.time, mpm::Accelerations::none);
  system.record.impulses.resize(2 * system.grid.boundaries().size());
  system.local = make_local_integrator(scene.constitutive);
  system.team = make_team(threads > 0 ? threads : thread_count(scene, system, available_threads()));
  build_contact(scene, system);
  build_tractions(scene, system);
  relax_bodies(scene, system);
  system.record.kinetic = mpm::kinetic_energy(system);
  return system;
}

}  // namespace vitrum
