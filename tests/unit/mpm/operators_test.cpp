#include <cmath>
#include <vector>

#include "catch.hpp"
#include "mpm/centroids.hpp"
#include "mpm/stress.hpp"
#include "mpm/transfer.hpp"
#include "support/mpm_run.hpp"
#include "support/random_states.hpp"

using namespace vitrum;
using namespace vitrum::mpm;
using namespace vitrum::test;

// What any method of lines needs of the operators, for particles at random places with random stresses and
// velocities.

namespace {

constexpr const char* geometries[] = {"plane-strain", "axisymmetric"};
constexpr const char* shapes[] = {"linear", "gimp", "bspline2"};

/// 30 x 20 cells of particles moved at random by up to 0.4 cells, some of them onto nodes, edges and next to
/// the axis.
MpmRun disordered(const char* geometry, const char* shape, const char* gradients = "nodes") {
  MpmScene scene;
  scene.geometry = geometry, scene.shape = shape, scene.gradients = gradients;
  const double left = std::string(geometry) == "axisymmetric" ? 0.0 : -13.0;
  scene.tables = body("body", box({left, -11.0}, {left + 30.0, 9.0}), "particles_per_cell = 4");
  MpmRun run(scene);
  Particles& p = run.particles();
  Random random(11);
  for (std::size_t i = 0; i < p.size; ++i) {
    for (std::size_t k = 0; k < 2; ++k) {
      double& x = p.position[k][i];
      x += random.uniform(-0.4, 0.4);
      if (random.chance(0.05)) x = std::round(x);
      if (random.chance(0.05)) x = std::floor(x) + 0.5;
      p.velocity[k][i] = random.uniform(-1.0, 1.0);
    }
    if (left == 0.0) p.position[0][i] = std::abs(p.position[0][i]);
    for (auto& e : p.elastic_strain) e[i] = random.uniform(-0.01, 0.01);
  }
  return run;
}

struct Case {
  const char *geometry, *shape, *gradients;
};
std::vector<Case> cases() {
  std::vector<Case> all;
  for (const char* geometry : geometries)
    for (const char* shape : shapes)
      for (const char* gradients : {"nodes", "centroids"}) all.push_back({geometry, shape, gradients});
  return all;
}

double sum(const Grid& grid, Field f) {
  double total = 0.0;
  for (std::size_t n = 0; n < grid.blocks().size() * block_nodes; ++n) total += grid.field(f)[n];
  return total;
}

}  // namespace

TEST_CASE("The nodes carry the particles' mass and momentum, and internal forces add up to nothing",
          "[mpm]") {
  for (const char* geometry : geometries)
    for (const char* shape : shapes) {
      CAPTURE(geometry, shape);
      MpmRun run = disordered(geometry, shape);
      refresh_grid(run.system);
      scatter(run.system, Scatter::momentum_and_force);
      const Particles& p = run.particles();
      const auto stress = stress_of(run.system.bodies[0]);
      double mass = 0.0, force_scale = 0.0;
      for (std::size_t i = 0; i < p.size; ++i)
        mass += p.mass[i], force_scale += p.mass[i] * std::abs(stress[0][i]);
      const auto momentum = total_momentum(run.system);
      const Grid& grid = run.system.grid;
      CHECK(sum(grid, Field::mass) == Approx(mass).epsilon(1e-13));
      CHECK(std::abs(sum(grid, Field::momentum_1) - momentum[1]) < 1e-13 * mass);
      CHECK(std::abs(sum(grid, Field::force_1)) < 1e-13 * force_scale);
      if (std::string(geometry) == "plane-strain") {  // radial components have no sum to keep
        CHECK(std::abs(sum(grid, Field::momentum_0) - momentum[0]) < 1e-13 * mass);
        CHECK(std::abs(sum(grid, Field::force_0)) < 1e-13 * force_scale);
      }
    }
}

TEST_CASE("Scattering in two passes gives what one pass gives, bit for bit", "[mpm]") {
  for (const char* shape : shapes) {
    MpmRun one = disordered("axisymmetric", shape), two = disordered("axisymmetric", shape);
    refresh_grid(one.system), refresh_grid(two.system);
    scatter(one.system, Scatter::momentum_and_force);
    scatter(two.system, Scatter::force);
    scatter(two.system, Scatter::momentum);
    for (const Field f : {Field::mass, Field::momentum_0, Field::momentum_1, Field::force_0, Field::force_1})
      for (std::size_t n = 0; n < one.system.grid.blocks().size() * block_nodes; ++n)
        REQUIRE(one.system.grid.field(f)[n] == two.system.grid.field(f)[n]);
  }
}

TEST_CASE(
    "Internal forces are the transpose of the strain rate: f . v = - sum V sigma : grad v for any nodal v",
    "[mpm]") {
  for (const auto& [geometry, shape, gradients] : cases()) {
    CAPTURE(geometry, shape, gradients);
    MpmRun run = disordered(geometry, shape, gradients);
    System& s = run.system;
    refresh_grid(s);
    find_centroids(s);
    scatter(s, Scatter::momentum_and_force);
    project_velocities(s);
    Random random(13);
    double power = 0.0, scale = 0.0;
    for (std::size_t n = 0; n < s.grid.blocks().size() * block_nodes; ++n) {
      const bool on_axis = s.grid.constraint(0, n) == Constraint::axis;
      const double v0 = on_axis ? 0.0 : random.uniform(-1.0, 1.0), v1 = random.uniform(-1.0, 1.0);
      s.grid.field(Field::velocity_0)[n] = v0, s.grid.field(Field::velocity_1)[n] = v1;
      power += s.grid.field(Field::force_0)[n] * v0 + s.grid.field(Field::force_1)[n] * v1;
    }
    const double duration = 1e-12;  // the turn of the particles' frames is as small
    gather(s, Gather::strain, duration);
    const Particles& p = run.particles();
    const auto stress = stress_of(run.system.bodies[0]);
    double stress_power = 0.0;
    for (std::size_t i = 0; i < p.size; ++i) {
      const double volume = p.mass[i];  // density 1
      const double density =
          (stress[0][i] * p.strain_increment[0][i] + stress[1][i] * p.strain_increment[1][i] +
           stress[2][i] * p.strain_increment[2][i] + 2.0 * stress[3][i] * p.strain_increment[3][i]) /
          duration;
      stress_power += volume * density;
      scale += std::abs(volume * density);
    }
    CAPTURE(power, stress_power);
    CHECK(std::abs(power + stress_power) < 1e-11 * scale);
  }
}

TEST_CASE("A uniform velocity is seen as such by every particle, without strain", "[mpm]") {
  for (const char* shape : shapes) {
    MpmRun run = disordered("plane-strain", shape);
    System& s = run.system;
    Particles& p = run.particles();
    p.velocity[0].assign(p.size, 0.7), p.velocity[1].assign(p.size, -0.3);
    refresh_grid(s);
    scatter(s, Scatter::momentum);
    project_velocities(s);
    gather(s, Gather::strain, 1.0);
    for (std::size_t i = 0; i < p.size; ++i) {
      for (const auto& e : p.strain_increment) REQUIRE(std::abs(e[i]) < 2e-15);
      REQUIRE(std::abs(p.spin_increment[i]) < 2e-15);
    }
  }
}

TEST_CASE("Operators give the same bits wherever particles lie in memory", "[mpm]") {
  for (const char* geometry : geometries)
    for (const char* shape : shapes) {
      CAPTURE(geometry, shape);
      MpmRun sorted = disordered(geometry, shape), mixed = disordered(geometry, shape);
      const std::size_t size = mixed.particles().size;
      std::vector<std::uint32_t> order(size);
      for (std::uint32_t i = 0; i < size; ++i) order[i] = (7919 * i) % static_cast<std::uint32_t>(size);
      reorder(mixed.particles(), order);
      REQUIRE(mixed.particles().identity == order);
      refresh_grid(sorted.system, Storage::sorted), refresh_grid(mixed.system, Storage::kept);
      for (MpmRun* run : {&sorted, &mixed}) {
        System& s = run->system;
        scatter(s, Scatter::momentum_and_force, Nodes::moved, 0.01);
        gather(s, Gather::velocity_and_rescatter, 0.01);
        StressUpdate stress(s, 0.01);
        sweep(s, {{gather_pass(s, Gather::strain_and_position, 0.01, &stress)}});
        stress.book();
      }
      CHECK(sorted.system.record.kinetic == mixed.system.record.kinetic);
      CHECK(sorted.system.record.elastic == mixed.system.record.elastic);
      const Particles &a = sorted.particles(), &b = mixed.particles();
      std::vector<std::size_t> place(size);
      for (std::size_t i = 0; i < size; ++i) place[b.identity[i]] = i;
      for (std::size_t i = 0; i < size; ++i) {
        const std::size_t j = place[a.identity[i]];
        for (std::size_t k = 0; k < 2; ++k) {
          REQUIRE(a.position[k][i] == b.position[k][j]);
          REQUIRE(a.velocity[k][i] == b.velocity[k][j]);
        }
        for (std::size_t k = 0; k < 4; ++k) REQUIRE(a.elastic_strain[k][i] == b.elastic_strain[k][j]);
      }
    }
}
