#include <cmath>

#include "catch.hpp"
#include "mpm/transfer.hpp"
#include "support/mpm_run.hpp"

using namespace vitrum;
using namespace vitrum::test;

// The adaptive methods at the ends of what a scene may ask for. Unit material: density, wave speed and cell
// are 1.

namespace {

struct Method {
  std::string name, lines;
};

std::string lines(double rtol, const std::string& more = "") {
  return fmt::format("rtol = {:g}\n{}", rtol, more);
}

/// A ball falls on a block at a twentieth of the wave speed: contact, compression, rebound.
MpmScene collision(const Method& method, const std::string& shape = "linear",
                   const std::string& geometry = "axisymmetric") {
  MpmScene scene;
  scene.geometry = geometry, scene.shape = shape, scene.method = method.name, scene.pace = method.lines;
  scene.tables = body("block", box({0.0, 0.0}, {6.0, 3.0}), "particles_per_cell = 4") +
                 body("ball", disk({0.0, 6.6}, 2.0), "particles_per_cell = 4\nvelocity = [0.0, -0.05]");
  return scene;
}

/// Runs to `end`; every step's energies are finite and never grow by more than 2 %.
void require_sound(MpmRun& run, double end, double most_growth = 1.02) {
  double largest = 0.0;
  run.watch = [&](double) {
    largest = std::max(largest, run.ledger.growth(run.integrator.tolerated_energy(run.system)));
    return std::isfinite(largest) && largest < 10.0;
  };
  run.advance(end);
  CAPTURE(largest, run.integrator.state().counters.steps, run.energy().relative_residual());
  REQUIRE(run.system.time == end);
  REQUIRE(largest <= most_growth);
  for (const Body& b : run.system.bodies)
    for (std::size_t i = 0; i < b.particles.size; ++i)
      REQUIRE(std::isfinite(b.particles.position[0][i] + b.particles.velocity[1][i] +
                            b.particles.elastic_strain[0][i]));
}

const char* const methods[] = {"arkode-explicit", "arkode-implicit"};

}  // namespace

TEST_CASE("Tolerances from 0.1 to 1e-12", "[stability][adaptive]") {
  for (const char* method : methods)
    for (const double rtol : {0.5, 0.1, 1e-3, 1e-6}) {
      CAPTURE(method, rtol);
      MpmRun run(collision({method, lines(rtol, "remap = 1.0")}, "bspline2"));
      require_sound(run, 60.0, rtol > 0.2 ? 1.2 : 1.02);
    }
  // So tight that steps are thousands of times shorter: a short while.
  for (const char* method : methods)
    for (const char* shape : {"linear", "bspline2"}) {
      CAPTURE(method, shape);
      MpmScene scene = collision({method, lines(1e-12, "order = 5\nremap = 1.0")}, shape);
      scene.tables = body("block", box({0.0, 0.0}, {3.0, 3.0}),
                          "particles_per_cell = 4\nvelocity_gradient = [[1e-3, 0.0], [0.0, -1e-3]]");
      MpmRun run(scene);
      require_sound(run, 0.5, 1.0 + 1e-7);
    }
}

TEST_CASE("Particles a rounding beside cell edges, and nodes of a mass fraction of 1e-15 and less",
          "[stability][adaptive]") {
  for (const char* method : methods)
    for (const char* shape : {"linear", "gimp", "bspline2"})
      for (const double beside : {1e-12, 1e-15, 0.0, -1e-12}) {
        CAPTURE(method, shape, beside);
        MpmRun run(collision({method, lines(1e-3, "remap = 0.5")}, shape));
        for (Body& b : run.system.bodies)
          for (auto& column : b.particles.position)
            for (std::size_t i = 0; i < column.size(); i += 3)
              column[i] = std::max(1e-13, std::round(column[i]) + beside);
        require_sound(run, 20.0);
      }
}

TEST_CASE("Bodies of one particle fly straight and bounce", "[stability][adaptive]") {
  for (const char* method : methods)
    for (const char* geometry : {"plane-strain", "axisymmetric"})
      for (const char* shape : {"linear", "gimp", "bspline2"}) {
        CAPTURE(method, geometry, shape);
        MpmScene scene;
        scene.geometry = geometry, scene.shape = shape, scene.method = method,
        scene.pace = lines(1e-4, "remap = 0.5");
        scene.tables = body("grain", box({0.0, 0.0}, {1.0, 1.0}), "velocity = [0.0, -0.25]");
        MpmRun alone(scene);
        require_sound(alone, 8.0, 1.0 + 1e-12);
        CHECK(alone.particles().position[1][0] == Approx(0.5 - 2.0).margin(1e-12));
        CHECK(alone.particles().velocity[1][0] == Approx(-0.25).margin(1e-13));
        scene.tables = body("grain", box({0.0, 0.0}, {1.0, 1.0}), "velocity = [0.0, -0.05]") +
                       body("other", box({0.0, -2.0}, {1.0, -1.0}));
        MpmRun meeting(scene);
        const double momentum = total_momentum(meeting.system)[1];
        require_sound(meeting, 40.0);
        CHECK(total_momentum(meeting.system)[1] == Approx(momentum).epsilon(1e-9));
      }
}

TEST_CASE("Phases from a thousandth of a step to the whole run", "[stability][adaptive]") {
  for (const double remap : {1e-3, 1e-1, 10.0, 1e3}) {
    CAPTURE(remap);
    MpmRun run(collision({"arkode-implicit", lines(1e-2, fmt::format("remap = {:g}\nremap_travel = {:g}",
                                                                     remap, remap > 1.0 ? 1e3 : 0.25))}));
    require_sound(run, remap < 1e-2 ? 2.0 : 40.0);
  }
}

TEST_CASE("Nearly incompressible, and a million times softer than its neighbour", "[stability][adaptive]") {
  for (const char* method : methods) {
    MpmScene scene = collision({method, lines(1e-2, "remap = 0.5")});
    scene.poisson = 0.499, scene.young = 3.0 * (1.0 - 2.0 * 0.499) * (1.0 / 1.002);
    CAPTURE(method);
    MpmRun incompressible(scene);
    require_sound(incompressible, 20.0);

    // The soft ball is 1e6 times softer and lands on the stiff block.
    MpmScene pair = collision({method, lines(1e-2, "remap = 0.5")});
    const std::string ball = "name = \"ball\"\nmaterial = \"elastic\"";
    pair.tables.replace(pair.tables.find(ball), ball.size(), "name = \"ball\"\nmaterial = \"soft\"");
    pair.tables +=
        fmt::format("[material.soft]\ndensity = 1.0\nyoung = {:.17g}\npoisson = 0.25\n", 1e-6 * unit_young);
    MpmRun ratio(pair);
    require_sound(ratio, 20.0);
  }
}

TEST_CASE("A thousand times finer steps change nothing but rounding", "[stability][adaptive]") {
  for (const char* method : methods) {
    const auto run_with = [&](double step) {
      MpmScene scene;
      scene.shape = "bspline2", scene.method = method;
      scene.pace =
          fmt::format("order = 4\nrtol = 1e-9\nfixed_step = {:g}\nremap = 10.0\nremap_travel = 10.0", step);
      scene.tables = body("block", box({0.0, 0.0}, {3.0, 3.0}),
                          "particles_per_cell = 4\nvelocity_gradient = [[1e-4, 5e-5], [0.0, -1e-4]]");
      MpmRun run(scene);
      run.advance(2.0);
      return run.particles().velocity;
    };
    const auto distance = [](const auto& a, const auto& b) {
      double largest = 0.0;
      for (std::size_t c = 0; c < 2; ++c)
        for (std::size_t i = 0; i < a[c].size(); ++i)
          largest = std::max(largest, std::abs(a[c][i] - b[c][i]));
      return largest / 3e-4;
    };
    const auto coarse = run_with(0.2), fine = run_with(0.02), finest = run_with(2e-4);
    CAPTURE(method, distance(coarse, finest), distance(fine, finest));
    CHECK(distance(coarse, finest) < 1e-2);
    CHECK(distance(fine, finest) < 1e-6);
  }
}

TEST_CASE("A collapsed step names what collapsed it", "[stability][adaptive]") {
  for (const char* method : methods) {
    // The shortest step is far too long for the tolerance.
    MpmRun run(collision({method, lines(1e-9, "min_step = 0.4\ninitial_step = 0.4\nremap = 1.0")}));
    try {
      run.advance(60.0);
      FAIL("no error");
    } catch (const ComputationError& error) {
      const std::string text = error.what();
      CAPTURE(text);
      CHECK(text.find("below integrator.min_step = 0.4 s") != std::string::npos);
      CHECK(text.find("largest weighted") != std::string::npos);
      CHECK((text.find("of body 'ba") != std::string::npos ||
             text.find("of body 'block'") != std::string::npos ||
             text.find("of the node at (") != std::string::npos));
      CHECK(text.find("integrator.rtol") != std::string::npos);
    }
    // What was computed stays: finite, at the time reached.
    CHECK(std::isfinite(mpm::kinetic_energy(run.system)));
  }
}

TEST_CASE("A step that cannot be taken leaves particles where the last one put them, as fast as they were",
          "[stability][adaptive]") {
  // A body that stretches: its first attempt would take it far.
  MpmScene scene;
  scene.method = "arkode-implicit";
  scene.pace = lines(1e-9, "min_step = 2.0\ninitial_step = 2.0\nremap = 10.0");
  scene.tables = body("block", box({-3.0, -3.0}, {3.0, 3.0}),
                      "particles_per_cell = 4\nvelocity_gradient = [[0.05, 0.0], [0.0, -0.05]]");
  MpmRun run(scene);
  const auto motion_of_each = [&] {
    const Particles& p = run.particles();
    std::vector<std::array<double, 4>> motions(p.size);
    for (std::size_t i = 0; i < p.size; ++i)
      motions[p.identity[i]] = {p.position[0][i], p.position[1][i], p.velocity[0][i], p.velocity[1][i]};
    return motions;
  };
  const auto before = motion_of_each();
  CHECK_THROWS_AS(run.advance(60.0), ComputationError);
  REQUIRE(run.integrator.state().counters.steps == 0);
  double farthest = 0.0;
  const auto after = motion_of_each();
  for (std::size_t i = 0; i < before.size(); ++i)
    for (std::size_t k = 0; k < before[i].size(); ++k)
      farthest = std::max(farthest, std::abs(after[i][k] - before[i][k]));
  CHECK(farthest < 1e-12);
}
