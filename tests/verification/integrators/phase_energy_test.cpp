#include <cmath>

#include "catch.hpp"
#include "integrators/grid/grid_system.hpp"
#include "integrators/sundials/ark_solver.hpp"
#include "support/mpm_run.hpp"
#include "support/random_states.hpp"

using namespace vitrum;
using namespace vitrum::sundials;
using namespace vitrum::test;

// Exact integration of a Lagrangian phase conserves kinetic energy of the grid + stored energy, and the remap
// gives the particles all of it. Of particles that are pressed far it loses a share of 1/2 q.(m - M).q, which
// is never negative.

namespace {

/// Two bodies whose particles lie anywhere and move at random.
MpmRun random_bodies(const std::string& geometry, const std::string& shape, double speed, Random& random,
                     const std::string& stress = "") {
  MpmScene scene;
  scene.geometry = geometry, scene.shape = shape;
  scene.tables = body("block", box({0.0, 0.0}, {5.0, 3.0}), "particles_per_cell = 4\n" + stress) +
                 body("ball", disk({2.0, 5.5}, 1.4));
  MpmRun run(scene);
  for (Body& b : run.system.bodies)
    for (std::size_t c = 0; c < 2; ++c)
      for (std::size_t i = 0; i < b.particles.size; ++i) {
        b.particles.position[c][i] = std::abs(b.particles.position[c][i] + random.uniform(-0.4, 0.4));
        b.particles.velocity[c][i] = speed * random.uniform(-1.0, 1.0);
      }
  run.system.grid_is_stale = true;
  run.reopen_ledger();
  return run;
}

struct PhaseEnergies {
  double before, on_grid, after, lumped_minus_consistent;  ///< 1/2 q.(m - M).q
};

/// One phase by order 5 and a tight tolerance.
PhaseEnergies take_phase(MpmRun& run, double duration, double speed) {
  System& system = run.system;
  GridSystem grid(system, {speed, speed, 1.0}, 1e-13);
  grid.begin_phase();
  const Context context;
  ArkSolver solver(context, *find_table(TableKind::diagonally_implicit, "ARKODE_ESDIRK547L2SA2_7_4_5"), {},
                   grid, LinearSolverKind::klu);
  solver.set_shortest_step(1e-9 * duration);
  grid.start(solver.y());
  const std::size_t n = grid.size() / 2;
  PhaseEnergies e{mpm::kinetic_energy(system) + stored_energy(system), 0.0, 0.0, 0.0};
  const auto velocities = [&] {
    std::vector<VectorColumns> v;
    for (const Body& b : system.bodies) v.push_back(b.particles.velocity);
    return v;
  };
  const auto old = velocities();
  solver.start(0.0, 1e-3 * duration);
  double t = 0.0;
  while (t < duration) {
    const auto step = solver.step(duration);
    REQUIRE(step.failure == ArkSolver::Failure::none);
    t = step.time;
    grid.commit(t, solver.y());
  }
  e.on_grid = system.record.kinetic + system.record.elastic;
  std::vector<double> mass(grid.pattern().row.size());
  grid.form(0.0, mass.data());
  for (std::size_t k = 0; k < n; ++k)
    for (auto at = grid.pattern().column[k]; at < grid.pattern().column[k + 1]; ++at)
      if (grid.pattern().row[static_cast<std::size_t>(at)] == static_cast<std::int64_t>(k))
        e.lumped_minus_consistent +=
            0.5 * mass[static_cast<std::size_t>(at)] * std::pow(solver.y()[grid.size() + k], 2);
  const double loss = grid.end_phase(solver.y());
  e.after = mpm::kinetic_energy(system) + stored_energy(system);
  const auto now = velocities();
  for (std::size_t b = 0; b < now.size(); ++b)
    for (std::size_t c = 0; c < 2; ++c)
      for (std::size_t i = 0; i < now[b][c].size(); ++i)
        e.lumped_minus_consistent -=
            0.5 * system.bodies[b].particles.mass[i] * std::pow(now[b][c][i] - old[b][c][i], 2);
  CHECK(loss == Approx(e.on_grid - e.after).margin(1e-12 * e.before));
  return e;
}

}  // namespace

TEST_CASE("A phase and its remap conserve energy to 1e-12, for random particles", "[verification][energy]") {
  Random random(23);
  for (const char* geometry : {"plane-strain", "axisymmetric"})
    for (const char* shape : {"linear", "gimp", "bspline2"})
      for (int repeat = 0; repeat < 3; ++repeat) {
        const double speed = 1e-13;
        MpmRun run = random_bodies(geometry, shape, speed, random);
        const PhaseEnergies e = take_phase(run, 1.5, speed);
        CAPTURE(geometry, shape, repeat, e.before, e.on_grid - e.before, e.after - e.before);
        CHECK(std::abs(e.on_grid - e.before) < 1e-12 * e.before);
        CHECK(std::abs(e.on_grid - e.after) < 1e-12 * e.before);
        CHECK(e.lumped_minus_consistent > 1e-3 * e.before);  // what lumped masses would lose
      }
}

TEST_CASE(
    "Where material is pressed far a remap loses what the masses say and gains nothing; pulled it loses "
    "nothing",
    "[verification][energy]") {
  Random random(31);
  for (const char* shape : {"linear", "gimp"})
    for (const bool pressed : {true, false}) {
      // The block alone is pressed by more than ConsistentMass::lumped_from, or pulled by as much.
      MpmRun run =
          random_bodies("plane-strain", shape, 0.01, random,
                        pressed ? "stress = [-0.05, -0.1, -0.03, 0.0]" : "stress = [0.05, 0.1, 0.03, 0.0]");
      const PhaseEnergies e = take_phase(run, 0.3, 0.01);
      CAPTURE(shape, pressed, e.before, e.on_grid - e.before, e.after - e.before);
      CHECK(std::abs(e.on_grid - e.before) < 1e-11 * e.before);
      if (!pressed) {
        CHECK(std::abs(e.on_grid - e.after) < 1e-11 * e.before);
        continue;
      }
      CHECK(e.after < e.on_grid - 1e-6 * e.before);
      CHECK(e.on_grid - e.after < e.lumped_minus_consistent);
    }
}

TEST_CASE(
    "With strains of ten percent a phase conserves energy as well: stress on the reference volume has a "
    "potential",
    "[verification][energy]") {
  Random random(29);
  for (const char* shape : {"linear", "bspline2"}) {
    MpmRun run = random_bodies("axisymmetric", shape, 0.1, random);
    const PhaseEnergies e = take_phase(run, 0.5, 0.1);
    CAPTURE(shape, (e.on_grid - e.before) / e.before, (e.after - e.before) / e.before);
    CHECK(std::abs(e.on_grid - e.before) < 1e-11 * e.before);
    CHECK(std::abs(e.on_grid - e.after) < 1e-12 * e.before);
  }
}

TEST_CASE("A body that turns by a quarter in one phase is not strained", "[verification][energy]") {
  MpmScene scene;
  scene.method = "arkode-implicit";
  scene.pace =
      "order = 3\nrtol = 1e-5\nvelocity_scale = 0.01\nstrain_scale = 1e-3\nremap = 1e9\nremap_travel = "
      "1e9\nremap_strain = 1e9";
  scene.tables = body("block", box({-2.0, -2.0}, {2.0, 2.0}),
                      "particles_per_cell = 4\nvelocity_gradient = [[0.0, -1e-3], [1e-3, 0.0]]");
  MpmRun run(scene);
  const double quarter = 0.5 * 3.14159265358979 / 1e-3;
  run.advance(quarter);
  CHECK(run.integrator.state().phases == 1);
  // Lumped masses turn a little more slowly than the particles would; strains are those of the centrifugal
  // force, of the order (w R / c)^2 = 1e-5.
  double largest = 0.0;
  for (const auto& e : run.particles().elastic_strain)
    for (const double x : e) largest = std::max(largest, std::abs(x));
  CAPTURE(largest);
  CHECK(largest < 3e-4);
}
