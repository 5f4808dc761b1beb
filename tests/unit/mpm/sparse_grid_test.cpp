#include <cmath>
#include <numeric>

#include "catch.hpp"
#include "mpm/transfer.hpp"
#include "support/mpm_run.hpp"
#include "support/random_states.hpp"
#include "unit/output/contains_text.hpp"

using namespace vitrum;
using namespace vitrum::mpm;
using namespace vitrum::test;

namespace {

constexpr const char* shapes[] = {"linear", "gimp", "bspline2"};

/// A ball that hits a block off-centre, everything moved by whole cells.
MpmScene impact(const char* shape, const char* scheme, double x, double y) {
  MpmScene scene;
  scene.shape = shape, scene.scheme = scheme, scene.pace = "step = 0.1";
  scene.tables = body("block", box({x, y}, {x + 14.0, y + 5.0})) +
                 body("ball", box({x + 4.0, y + 6.0}, {x + 8.0, y + 9.0}),
                      "particles_per_cell = 4\nvelocity = [0.02, -0.1]");
  return scene;
}

}  // namespace

TEST_CASE("Two bodies a million cells apart cost only their own blocks", "[mpm][grid]") {
  MpmScene scene;
  scene.tables =
      body("here", box({0.0, 0.0}, {10.0, 10.0})) + body("there", box({1e6, 1e6}, {1e6 + 10.0, 1e6 + 10.0}));
  MpmRun run(scene);
  run.system.coasting_settled = true;  // (both would coast, without any block)
  run.advance(0.2);
  CHECK(run.system.grid.tiles().size() == 8);
  CHECK(run.system.grid.blocks().size() <= 18);
}

TEST_CASE("Block borders do not change results: scenes moved by whole cells agree to rounding",
          "[mpm][grid]") {
  for (const char* shape : shapes)
    for (const char* scheme : {"usf", "musl"})
      for (const auto& [dx, dy] : {std::pair{8.0, 3.0}, std::pair{-21.0, 5.0}, std::pair{3.0, -40.0}}) {
        CAPTURE(shape, scheme, dx, dy);
        MpmRun here(impact(shape, scheme, 0.0, 0.0)), there(impact(shape, scheme, dx, dy));
        here.advance(30.0), there.advance(30.0);
        CHECK(here.energy().elastic > 1e-3 * here.energy().initial);
        double worst = 0.0;
        for (std::size_t n = 0; n < 2; ++n) {
          const Particles &a = here.particles(n), &b = there.particles(n);
          for (std::size_t i = 0; i < a.size; ++i)
            worst = std::max({worst, std::abs(a.position[0][i] + dx - b.position[0][i]),
                              std::abs(a.position[1][i] + dy - b.position[1][i]),
                              std::abs(a.elastic_strain[0][i] - b.elastic_strain[0][i]),
                              std::abs(a.velocity[1][i] - b.velocity[1][i])});
        }
        CAPTURE(worst);
        CHECK(worst < 1e-11);
      }
}

TEST_CASE("A body that flies a hundred thousand cells keeps its shape and momentum", "[mpm][grid]") {
  for (const char* shape : shapes) {
    CAPTURE(shape);
    MpmScene scene;
    scene.shape = shape, scene.scheme = "musl", scene.pace = "step = 5e-4";
    // Half a cell a step, onto and off nodes, at a thousand times the wave speed: elasticity has no time to
    // amplify rounding (a body that flies slowly has: explicit steps pump a little energy into its vibrations
    // at every crossing).
    scene.tables = body("bullet", box({0.0, 0.0}, {2.0, 1.0}), "velocity = [1000.0, 250.0]");
    MpmRun run(scene);
    const auto start = run.particles().position;
    const auto momentum = total_momentum(run.system);
    run.advance(100.0);
    const Particles& p = run.particles();
    double worst = 0.0, strain = 0.0;
    for (std::size_t i = 0; i < p.size; ++i)
      for (std::size_t k = 0; k < 2; ++k) {
        const double moved = p.position[k][i] - start[k][i] - (k == 0 ? 1e5 : 2.5e4);
        worst = std::max(worst, std::abs(moved));
        strain = std::max(strain, std::abs(p.elastic_strain[k][i]));
      }
    const auto after = total_momentum(run.system);
    CAPTURE(worst, strain);
    CHECK(worst < 1e-5);  // 2e5 additions at 1e5: rounding adds up to 2e5 x 1e-11 at most
    CHECK(strain < 1e-9);
    CHECK(after[0] == Approx(momentum[0]).epsilon(1e-10));
    CHECK(after[1] == Approx(momentum[1]).epsilon(1e-10));
    CHECK(run.system.grid.blocks().size() <= 9);
  }
}

TEST_CASE(
    "The state after a hundred steps of an impact is the same, bit for bit, with one, two and three threads",
    "[mpm][grid]") {
  const std::string models =
      "[material.elastic.damage]\ntoughness = 0.83e6\nk = 5.0e26\nm = 6\n"
      "[material.elastic.drucker_prager]\nyield = 43.0e6\nbeta = 1.8\n"
      "[material.elastic.decohesion]\nopening = 5.0e-6\nmode_ratio = 50.0\n";
  for (const char* scheme : {"usf", "usl", "musl"}) {
    CAPTURE(scheme);
    MpmScene scene;
    scene.geometry = "axisymmetric", scene.cell = 1e-3, scene.shape = "linear", scene.scheme = scheme;
    const double step = std::string(scheme) == "usl" ? 3e-9 : 3e-8;
    scene.pace = fixed_step(step);
    scene.density = 2500.0, scene.young = 72e9, scene.poisson = 0.25;
    scene.tables =
        body("plate", box({0.0, 0.0}, {0.04, 0.005}), "particles_per_cell = 4") +
        body("ball", box({0.0, 0.005}, {0.003, 0.011}), "particles_per_cell = 4\nvelocity = [0.0, -200.0]") +
        models;
    MpmRun one(scene, 1), two(scene, 2), three(scene, 3);
    for (MpmRun* run : {&one, &two, &three}) run->advance(100 * step);
    REQUIRE(one.system.step_index == 100);
    CHECK(one.energy().damage + one.energy().plastic > 0.0);
    for (MpmRun* other : {&two, &three}) {
      for (std::size_t n = 0; n < 2; ++n) {
        const Particles &a = one.particles(n), &b = other->particles(n);
        CHECK(a.position == b.position);
        CHECK(a.velocity == b.velocity);
        CHECK(a.elastic_strain == b.elastic_strain);
        CHECK(a.variables == b.variables);
      }
      CHECK(one.energy().residual() == other->energy().residual());
      CHECK(one.system.record.elastic == other->system.record.elastic);
    }
  }
}

TEST_CASE("Lists amended for the particles that left are those of a rebuild", "[mpm][grid]") {
  Random random(20261125);
  const int threads = GENERATE(1, 3);
  for (const char* shape : shapes) {
    CAPTURE(shape, threads);
    MpmScene scene;
    scene.geometry = "axisymmetric", scene.cell = 1.0, scene.shape = shape;
    scene.tables = body("left", box({0.0, 0.0}, {12.0, 20.0}), "particles_per_cell = 4") +
                   body("right", box({12.0, 0.0}, {21.0, 20.0}), "particles_per_cell = 1");
    MpmRun run(scene, threads);
    mpm::Grid& grid = run.system.grid;
    mpm::refresh_grid(run.system);
    mpm::Grid anew = grid;
    double mass = 0.0;
    for (std::size_t n = 0; n < 2; ++n)
      mass += std::accumulate(run.particles(n).mass.begin(), run.particles(n).mass.end(), 0.0);
    std::size_t changed_blocks = 0, same_blocks = 0;
    for (int round = -10; round < 60; ++round) {
      CAPTURE(round);
      // First only within the blocks that there are. Then a few particles far, or all of them a little, or a
      // part of them together: into blocks that exist and into others, out of blocks that are empty then.
      const bool inside = round < 0, few = !inside && round % 3 == 0;
      const double far = few ? 30.0 : 0.8, share = few ? 0.02 : 1.0,
                   drift = !inside && round % 3 == 2 ? 3.0 : 0.0;
      for (std::size_t n = 0; n < 2; ++n)
        for (std::size_t i = 0; i < run.particles(n).size; ++i) {
          if (!random.chance(share)) continue;
          auto& x = run.particles(n).position;
          if (inside && (x[0][i] < 3.0 || x[0][i] > 18.0 || x[1][i] < 3.0 || x[1][i] > 17.0)) continue;
          x[0][i] = std::abs(x[0][i] + random.uniform(-far, far));
          x[1][i] += random.uniform(-far, far) + (n == 0 ? drift : -drift);
        }
      for (std::size_t tile = 0; tile < grid.tiles().size(); ++tile)
        grid.note_moved(tile, run.system.bodies, grid.has_left(tile, run.system.bodies));
      const std::size_t blocks = grid.blocks().size();
      const bool some_left = grid.some_left();
      grid.relist(run.system.bodies, *run.system.team);
      anew.rebuild(run.system.bodies);
      changed_blocks += grid.blocks().size() != blocks ? 1 : 0;
      same_blocks += inside && some_left && grid.blocks().size() == blocks ? 1 : 0;
      CHECK_FALSE(grid.some_left());
      REQUIRE(grid.tiles() == anew.tiles());
      for (std::size_t tile = 0; tile < grid.tiles().size(); ++tile) {
        const mpm::Block &a = grid.blocks()[tile], &b = anew.blocks()[tile];
        REQUIRE((a.column == b.column && a.row == b.row && a.constrained == b.constrained));
        REQUIRE_FALSE(grid.has_left(tile, run.system.bodies));
        for (std::size_t n = 0; n < 2; ++n) {
          const auto mine = grid.particles(tile, n), theirs = anew.particles(tile, n);
          REQUIRE(std::equal(mine.begin, mine.end, theirs.begin, theirs.end));
        }
      }
      // All nodes that particles touch are there.
      mpm::scatter(run.system, Scatter::momentum);
      const double* nodal = grid.field(Field::mass);
      CHECK(std::accumulate(nodal, nodal + grid.blocks().size() * block_nodes, 0.0) ==
            Approx(mass).epsilon(1e-12));
      if (round % 10 == 0)
        grid.sort_storage(run.system.bodies, *run.system.team,
                          round % 20 == 0 ? static_cast<std::size_t>(threads) : 1);
      if (round % 10 == 0) {
        REQUIRE(grid.scattered() == 0);
        anew.rebuild(run.system.bodies);
        REQUIRE(anew.scattered() == 0);
      }
    }
    CHECK(changed_blocks > 10);
    CHECK(same_blocks == 10);
  }
}

TEST_CASE("Which of many lost particles an error names does not depend on threads", "[mpm][grid]") {
  MpmScene scene;
  scene.geometry = "plane-strain", scene.cell = 1.0;
  scene.tables = body("sheet", box({0.0, 0.0}, {200.0, 40.0}), "particles_per_cell = 4");
  for (const int threads : {1, 2, 3})
    for (int repeat = 0; repeat < 10; ++repeat) {
      CAPTURE(threads, repeat);
      MpmRun run(scene, threads);
      mpm::refresh_grid(run.system);
      Particles& p = run.particles();
      std::uint32_t first = std::numeric_limits<std::uint32_t>::max();
      for (std::size_t i = 100; i < p.size; i += 37) p.position[1][i] = std::nan("");
      for (std::size_t i = 0; i < p.size; ++i)
        if (std::isnan(p.position[1][i])) first = std::min(first, p.identity[i]);
      for (std::size_t tile = 0; tile < run.system.grid.tiles().size(); ++tile)
        run.system.grid.note_moved(tile, run.system.bodies, true);
      CHECK_THROWS_WITH(mpm::refresh_grid(run.system),
                        contains_text("particle " + std::to_string(first) + ": position is nan"));
    }
}
