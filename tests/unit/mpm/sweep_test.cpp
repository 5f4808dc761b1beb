#include <cstdlib>
#include <memory>
#include <set>
#include <vector>

#include "integrators/grid/critical_step.hpp"
#include "mpm/nodes.hpp"
#include "mpm/transfer.hpp"
#include "support/mpm_run.hpp"
#include "support/random_states.hpp"
#include "tests/catch.hpp"

using namespace vitrum;
using namespace vitrum::mpm;
using namespace vitrum::test;

namespace {

constexpr const char* shapes[] = {"linear", "gimp", "bspline2"};

/// Two bodies in motion, tall or wide.
MpmScene scene_of(const char* shape, bool tall) {
  MpmScene scene;
  scene.geometry = "axisymmetric", scene.cell = 1.0, scene.shape = shape;
  scene.tables = tall ? body("one", box({0.0, 0.0}, {30.0, 90.0}), "particles_per_cell = 4") +
                            body("two", box({30.0, 0.0}, {40.0, 90.0}), "particles_per_cell = 1")
                      : body("one", box({0.0, 0.0}, {90.0, 20.0}), "particles_per_cell = 4") +
                            body("two", box({0.0, 20.0}, {60.0, 30.0}), "particles_per_cell = 1");
  return scene;
}

void set_in_motion(MpmRun& run) {
  Random random(7);
  for (std::size_t n = 0; n < 2; ++n)
    for (auto& v : run.particles(n).velocity)
      for (double& value : v) value = random.uniform(-1.0, 1.0);
}

}  // namespace

TEST_CASE("Strips hold every tile and block once, and share nodes with the strips beside them only",
          "[mpm][grid]") {
  for (const char* shape : shapes)
    for (const bool tall : {true, false}) {
      CAPTURE(shape, tall);
      MpmRun run(scene_of(shape, tall));
      // Debris far away, and a gap in the middle.
      auto& x = run.particles(0).position;
      for (std::size_t i = 0; i < run.particles(0).size; i += 97) x[1][i] += 400.0;
      for (std::size_t i = 0; i < run.particles(0).size; i += 89) x[0][i] += 300.0;
      refresh_grid(run.system);
      const Grid& grid = run.system.grid;
      const parallel::Strips& strips = grid.strips();
      std::vector<int> tiles(grid.tiles().size()), blocks(grid.blocks().size());
      std::vector<std::size_t> strip_of(blocks.size());
      for (std::size_t strip = 0; strip + 1 < strips.first_pieces.size(); ++strip) {
        REQUIRE(strips.first_pieces[strip] < strips.first_pieces[strip + 1]);
        for (std::size_t n = strips.first_pieces[strip]; n < strips.first_pieces[strip + 1]; ++n) {
          CHECK(strips.pieces[n].last_tile - strips.pieces[n].first_tile <= 1);
          strips.pieces[n].for_tiles([&](std::size_t tile) { ++tiles[tile]; });
          strips.pieces[n].for_blocks([&](std::size_t block) { ++blocks[block], strip_of[block] = strip; });
        }
      }
      for (const int n : tiles) CHECK(n == 1);
      for (const int n : blocks) CHECK(n == 1);
      for (std::size_t block = 0; block < blocks.size(); ++block)
        for (const std::int32_t other : grid.blocks()[block].neighbours)
          if (other >= 0) {
            const std::size_t theirs = strip_of[static_cast<std::size_t>(other)], mine = strip_of[block];
            CHECK((theirs > mine ? theirs - mine : mine - theirs) <= 1);
          }
      CHECK(strips.first_pieces.size() > 8);
    }
}

namespace {

constexpr double duration = 0.01;

/// New nodal velocities, and the work done on them.
void accelerate_all(System& s) {
  const std::size_t blocks = s.grid.blocks().size();
  for (std::size_t block = 0; block < blocks; ++block)
    accelerate_block(s.grid, block, block_vector(s.grid, block, Field::force_0), s.gravity, duration);
  double power = 0.0;
  for (std::size_t block = 0; block < blocks; ++block)
    power += external_power(s, block, block_vector(s.grid, block, Field::force_0), Field::velocity_0,
                            Field::new_velocity_0);
  s.record.external_work += duration * power;
}

void take_passes_one_by_one(System& s, StepScheme scheme) {
  s.record.external_work = 0.0;
  refresh_grid(s);
  scatter(s, scheme == StepScheme::usf ? Scatter::momentum : Scatter::momentum_and_force);
  project_velocities(s);
  if (scheme == StepScheme::usf) {
    gather(s, Gather::strain, duration);
    update_stress(s, duration);
    scatter(s, Scatter::force);
  }
  accelerate_all(s);
  if (scheme == StepScheme::usf) {
    gather(s, Gather::velocity_and_position, duration);
    return;
  }
  if (scheme == StepScheme::musl) gather(s, Gather::velocity_and_rescatter, duration);
  gather(s, scheme == StepScheme::usl ? Gather::all_from_new : Gather::strain_and_position, duration);
  update_stress(s, duration);
}

void take_wave(System& s, StepScheme scheme) {
  s.record.external_work = 0.0;
  refresh_grid(s);
  StressUpdate stress(s, duration);
  const auto to_nodes = [&](Scatter what) { return scatter_pass(s, what, Nodes::moved, duration); };
  const auto back = [&](Gather what, StressUpdate* update = nullptr) {
    return gather_pass(s, what, duration, update);
  };
  if (scheme == StepScheme::usf)
    sweep(s, {{to_nodes(Scatter::momentum), back(Gather::strain, &stress), to_nodes(Scatter::force),
               back(Gather::velocity_and_position)}});
  else if (scheme == StepScheme::usl)
    sweep(s, {{to_nodes(Scatter::momentum_and_force), back(Gather::all_from_new, &stress)}});
  else
    sweep(s, {{to_nodes(Scatter::momentum_and_force), back(Gather::velocity_and_rescatter),
               back(Gather::strain_and_position, &stress)}});
  stress.book();
}

}  // namespace

TEST_CASE("Passes taken as one wave give the bits of passes taken one by one, by any number of threads",
          "[mpm]") {
  for (const StepScheme scheme : {StepScheme::usf, StepScheme::usl, StepScheme::musl})
    for (const char* shape : shapes)
      for (const bool tall : {true, false}) {
        MpmScene scene = scene_of(shape, tall);
        // Debris that changes blocks, gravity, a wall that moves, and flow.
        scene.tables +=
            "[gravity]\nacceleration = [0, -0.1]\n" + hold("[-inf, -1]", "[inf, 3]", "\"z\"", {0.0, 0.02}) +
            "[material.elastic.von_mises]\nyield = 2e-3\npeak = 2e-3\nhardening = 0\nsoftening = 0\n";
        const auto made = [&](int threads) {
          auto run = std::make_unique<MpmRun>(scene, threads);
          set_in_motion(*run);
          return run;
        };
        const auto apart = made(1);
        std::vector<std::unique_ptr<MpmRun>> runs;
        for (const int threads : {1, 2, 3}) runs.push_back(made(threads));
        for (int step = 0; step < 4; ++step) {
          take_passes_one_by_one(apart->system, scheme);
          for (const auto& run : runs) {
            CAPTURE(static_cast<int>(scheme), shape, tall, step, run->system.team->size());
            take_wave(run->system, scheme);
            for (std::size_t n = 0; n < 2; ++n) {
              const Particles &a = apart->particles(n), &b = run->particles(n);
              CHECK(a.position == b.position);
              CHECK(a.velocity == b.velocity);
              CHECK(a.elastic_strain == b.elastic_strain);
              CHECK(a.variables == b.variables);
            }
            CHECK(apart->system.record.kinetic == run->system.record.kinetic);
            CHECK(apart->system.record.external_work == run->system.record.external_work);
            CHECK(run->system.record.external_work != 0.0);
            CHECK(run->system.record.elastic == runs[0]->system.record.elastic);
            CHECK(run->system.record.dissipated.plastic == runs[0]->system.record.dissipated.plastic);
          }
        }
        CHECK(apart->system.record.dissipated.plastic > 0.0);
      }
}

TEST_CASE("Tiles that share their data, where a thread's do not fit its cache, give the same bits", "[mpm]") {
  MpmScene scene;
  scene.geometry = "plane-strain", scene.cell = 1.0;
  // Strips of unlike numbers of tiles, in a few of them two stretches.
  scene.tables = body("one", box({0.0, 0.0}, {300.0, 160.0}), "particles_per_cell = 1") +
                 body("two", box({300.0, 40.0}, {400.0, 80.0}), "particles_per_cell = 1") +
                 body("three", box({320.0, 100.0}, {380.0, 120.0}), "particles_per_cell = 1");
  for (const StepScheme scheme : {StepScheme::usf, StepScheme::musl})
    for (const char* shape : {"linear", "bspline2"}) {
      scene.shape = shape;
      const auto made = [&](int threads) {
        auto run = std::make_unique<MpmRun>(scene, threads);
        Random random(7);
        for (std::size_t n = 0; n < 3; ++n)
          for (auto& v : run->particles(n).velocity)
            for (double& value : v) value = random.uniform(-10.0, 10.0);  // up to a tenth of a cell in a step
        return run;
      };
      const auto alone = made(1), apart = made(3);
      std::vector<std::unique_ptr<MpmRun>> runs;
      for (const int threads : {2, 3}) runs.push_back(made(threads));
      for (int step = 0; step < 3; ++step) {
        take_passes_one_by_one(alone->system, scheme);
        take_passes_one_by_one(apart->system, scheme);
        for (const auto& run : runs) take_wave(run->system, scheme);
        const auto check = [&](MpmRun& run) {
          CAPTURE(static_cast<int>(scheme), shape, step, run.system.team->size());
          std::set<const TileData*> data;
          Grid& grid = run.system.grid;
          for (std::size_t tile = 0; tile < grid.tiles().size(); ++tile) data.insert(&grid.tile_data(tile));
          CHECK(data.size() < grid.tiles().size());
          for (std::size_t n = 0; n < 3; ++n) {
            const Particles &a = alone->particles(n), &b = run.particles(n);
            CHECK(a.identity == b.identity);
            CHECK(a.position == b.position);
            CHECK(a.velocity == b.velocity);
            CHECK(a.elastic_strain == b.elastic_strain);
          }
        };
        check(*apart);
        for (const auto& run : runs) check(*run);
      }
    }
}
