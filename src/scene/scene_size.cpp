#include "scene/scene_size.hpp"

#include <algorithm>
#include <cmath>

#include "integrators/grid/grid_method.hpp"
#include "mpm/grid.hpp"
#include "scene/shape_measures.hpp"

namespace vitrum {
namespace {

// Bytes. Fitted to the peak memory of runs with 2e4 to 1e6 particles and rounded up; a test compares them
// with it.

/// Columns of a particle that every material has, its place in the grid's lists, and what an output, a
/// checkpoint or the analysis of fragments holds besides while it is made: an output its fields, what is
/// drawn of them, and the file of both.
constexpr double of_particle = 8.0 * 9.0 + 12.0 + 540.0;
/// The same for each of the material's variables.
constexpr double of_variable = 8.0 + 4.0 * 8.0;
/// Nodal fields, the tile and the bookkeeping of a block of nodes.
constexpr double of_block =
    mpm::block_nodes * (mpm::field_count * 8.0 + 4.0) + static_cast<double>(sizeof(mpm::TileData)) + 400.0;
/// arkode-explicit: vectors of 9 unknowns a particle, some for each stage and some besides.
constexpr double of_unknowns = 9.0 * 8.0, vectors = 9.5, vectors_of_stage = 1.0;
/// arkode-implicit: vectors over nodes and particles, tangents, the masses, and the matrix.
constexpr double of_implicit_cell = 7000.0;
/// The factors and their copy (KluFactors): entries grow with a body's width in cells, less than in
/// proportion (minimum degree).
constexpr double of_factor = 2500.0, fill_exponent = 0.45, wider_stencil = 3.2;

double blocks(const ShapeMeasures& m, double cell) {
  const double side = mpm::block_side * cell;
  return m.area / (side * side) + m.perimeter / side + 2.0;
}

double factor(const ShapeMeasures& m, const Scene& scene) {
  const double cells = m.area / (scene.cell * scene.cell), front = std::max(m.width / scene.cell, 1.0);
  return of_factor * cells * std::pow(front, fill_exponent) *
         (scene.shape_functions == mpm::ShapeKind::linear ? 1.0 : wider_stencil);
}

bool factorises(const IntegratorDefinition& i) {
  return i.method == GridMethod::arkode_implicit &&
         (i.linear_solver == LinearSolver::klu || i.preconditioner == Preconditioner::factor);
}

}  // namespace

SceneSize size_of(const Scene& scene) {
  SceneSize size;
  for (std::size_t n = 0; n < scene.bodies.size(); ++n) {
    const BodyDefinition& body = scene.bodies[n];
    const ShapeMeasures m = measures(body, scene.geometry);
    const double cells = m.area / (scene.cell * scene.cell);
    const double particles = std::max(1.0, std::round(cells * body.particles_per_cell));
    const auto variables =
        static_cast<double>(make_material(scene.material_of(n), scene.cell)->variables().size());
    size.particles.push_back(particles);
    size.all_particles += particles;
    size.cells += std::max(cells, 1.0);
    size.memory += particles * (of_particle + of_variable * variables) + of_block * blocks(m, scene.cell);
    if (factorises(scene.integrator)) size.factor_memory += factor(m, scene);
  }
  if (scene.integrator.method == GridMethod::arkode_explicit)
    size.memory += size.all_particles * of_unknowns *
                   (vectors + vectors_of_stage * butcher_table(scene.integrator).stages);
  if (scene.integrator.method == GridMethod::arkode_implicit)
    size.memory += size.cells * of_implicit_cell + size.factor_memory;
  return size;
}

}  // namespace vitrum
