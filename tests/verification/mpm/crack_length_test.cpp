// L_e where rows of particles share the strain of a cell: a crack dissipates the energy of its area once.
#include "mpm/crack_length.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/contact_scenes.hpp"
#include "support/random_states.hpp"
#include "tests/catch.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

constexpr double cell = 0.5e-3, opening = 3e-6;

/// A bar in uniaxial strain that is pulled apart, elastic but for `rows` rows of a cell of n rows in its
/// middle.
MpmScene weak_rows(int n, int rows, const Integrator& integrator) {
  MpmScene scene;
  scene.cell = cell, scene.density = 2500.0, scene.young = 72e9, scene.poisson = 0.25;
  integrator.choose(scene);
  scene.pace = (scene.method == "explicit" ? "step = " : "fixed_step = ") + number(2.5e-9);
  const double width = rows * cell / n, end = 5e-3;
  const std::string more =
      fmt::format("particles_per_cell = {}\nvelocity_gradient = [[9000, 0], [0, 0]]", n * n);
  std::string middle = body("weak", box({0.0, 0.0}, {width, cell}), more);
  middle.replace(middle.find("elastic"), 7, "glass");
  scene.tables = "[contact]\nmethod = \"single\"\n" + hold_everywhere("y") +
                 body("left", box({-end, 0.0}, {0.0, cell}), more) + middle +
                 body("right", box({width, 0.0}, {end, cell}), more) +
                 "[material.glass]\ndensity = 2500\nyoung = 72e9\npoisson = 0.25\n"
                 "[material.glass.damage]\ntoughness = 0.83e6\nk = 5e26\nm = 6\nrate = {fixed = 1e4}\n"
                 "[material.glass.decohesion]\nopening = 3e-6\nq = 1\nmode_ratio = 50\n";
  return scene;
}

std::vector<double>& column(Body& body, const char* name) {
  return body.particles.variables[body.material->column(name).value()];
}

/// A block of cracked particles, n x n a cell, with a normal at an angle.
MpmRun cracked_block(int n, double angle) {
  MpmScene scene;
  scene.cell = cell, scene.shape = "gimp";
  scene.tables =
      body("block", box({0.0, 0.0}, {8 * cell, 8 * cell}), fmt::format("particles_per_cell = {}", n * n)) +
      fmt::format("[material.elastic.decohesion]\nopening = {}\nq = 1\nmode_ratio = 1\n", opening);
  MpmRun run(scene);
  Body& block = run.system.bodies[0];
  const double r = std::cos(angle), z = std::sin(angle);
  for (std::size_t i = 0; i < block.particles.size; ++i) {
    column(block, "normal_r")[i] = r, column(block, "normal_z")[i] = z;
    column(block, "effective_length")[i] = cell * std::max(std::abs(r), std::abs(z));
    run.system.record.events.push_back({0, i, {EventKind::localisation, 0.0, 0.0}});
  }
  return run;
}

}  // namespace

TEST_CASE(
    "Rows of a cell, one of which localises, dissipate the energy of the crack's area, as all do together",
    "[verification][mpm][crack_length]") {
  for (const Integrator& integrator : five_integrators)
    for (const auto& [n, rows] : {std::pair{1, 1}, {2, 1}, {2, 2}, {3, 1}, {3, 2}, {3, 3}}) {
      if (integrator.name == "usl" || (integrator.name != "musl" && n == 3)) continue;
      CAPTURE(integrator.name, n, rows);
      MpmRun run(weak_rows(n, rows, integrator));
      run.advance(1.2e-6);
      Body& weak = run.system.bodies[1];
      double area = 0.0, energy = 0.0, least = 1.0;
      for (std::size_t i = 0; i < weak.particles.size; ++i) {
        const double part = weak.particles.mass[i] / 2500.0 / column(weak, "effective_length")[i];
        const double lambda = column(weak, "decohesion")[i];
        area += part;
        energy += part * opening * column(weak, "cohesive_strength")[i] * lambda * (1.0 - 0.5 * lambda);
        least = std::min(least, lambda);
      }
      CHECK(least > 0.3);
      CHECK(area == Approx(cell).epsilon(1e-9));
      // In the step of the onset the length is still that of the cell.
      CHECK(run.energy().fracture == Approx(energy).epsilon(0.03));
    }
}

TEST_CASE("A block that cracks all over has the length of the cell, a row of it that of its own part",
          "[mpm][crack_length]") {
  for (const int n : {1, 2, 3, 4})
    for (const double angle : {0.0, 0.3, 0.7, 0.25 * std::numbers::pi, 1.2, 0.5 * std::numbers::pi}) {
      CAPTURE(n, angle);
      MpmRun all = cracked_block(n, angle);
      const double way = std::max(std::abs(std::cos(angle)), std::abs(std::sin(angle)));
      column(all.system.bodies[0], "opening_n").assign(all.particles().size, 2e-7);
      mpm::share_cracks(all.system);
      Body& block = all.system.bodies[0];
      for (std::size_t i = 0; i < block.particles.size; ++i) {
        const double x = block.particles.position[0][i] / cell, y = block.particles.position[1][i] / cell;
        if (std::min(x, y) < 1.5 || std::max(x, y) > 6.5) continue;
        CHECK(column(block, "effective_length")[i] == Approx(cell * way));
        CHECK(column(block, "opening_n")[i] == Approx(2e-7));
      }
      MpmRun one = cracked_block(n, angle);
      Body& alone = one.system.bodies[0];
      for (std::size_t i = 0; i < alone.particles.size; ++i)
        if (i != alone.particles.size / 2) column(alone, "effective_length")[i] = 0.0;
      column(alone, "opening_n")[alone.particles.size / 2] = 2e-7;
      one.system.record.events.assign(1, {0, alone.particles.size / 2, {EventKind::localisation, 0.0, 0.0}});
      mpm::share_cracks(one.system);
      CHECK(column(alone, "effective_length")[alone.particles.size / 2] == Approx(cell * way / n));
      CHECK(column(alone, "opening_n")[alone.particles.size / 2] == Approx(2e-7 / n));
    }
}

TEST_CASE(
    "Lengths of cracks depend neither on how particles are stored nor on where the block stands, and only "
    "those near a new crack change",
    "[mpm][crack_length]") {
  Random random(3);
  MpmRun run = cracked_block(3, 0.4), moved = cracked_block(3, 0.4);
  Body &body = run.system.bodies[0], &other = moved.system.bodies[0];
  const std::size_t size = body.particles.size;
  run.system.record.events.clear();
  for (std::size_t i = 0; i < size; ++i) {
    const double turn = random.uniform(0.0, 3.0);
    column(body, "normal_r")[i] = std::cos(turn), column(body, "normal_z")[i] = std::sin(turn);
    if (random.chance(0.4)) column(body, "effective_length")[i] = 0.0;
    for (std::size_t c = 0; c < 2; ++c) body.particles.position[c][i] += random.uniform(-0.1, 0.1) * cell;
  }
  std::size_t first = 0;
  while (!(column(body, "effective_length")[first] > 0.0) || body.particles.position[0][first] < 4 * cell ||
         body.particles.position[1][first] < 4 * cell)
    ++first;
  run.system.record.events.push_back({0, first, {EventKind::localisation, 0.0, 0.0}});
  std::vector<std::uint32_t> order(size);
  for (std::uint32_t i = 0; i < size; ++i) order[i] = static_cast<std::uint32_t>(size - 1) - i;
  other.particles = body.particles;
  reorder(other.particles, order);
  for (double& r : other.particles.position[0])
    r += 64 * cell;  // a shift without rounding would be too much to ask
  moved.system.record.events.assign(1, {0, size - 1 - first, {EventKind::localisation, 0.0, 0.0}});
  const std::vector<double> before = column(body, "effective_length");
  mpm::share_cracks(run.system), mpm::share_cracks(moved.system);
  int changed = 0;
  for (std::size_t i = 0; i < size; ++i) {
    const double now = column(body, "effective_length")[i];
    CHECK(column(other, "effective_length")[size - 1 - i] == Approx(now).epsilon(1e-12));
    const double far = std::hypot(body.particles.position[0][i] - body.particles.position[0][first],
                                  body.particles.position[1][i] - body.particles.position[1][first]);
    if (now != before[i]) ++changed;
    CHECK((now == before[i] || far < 1.5 * cell));
  }
  CHECK(changed > 3);
}
