#include "integrators/grid/particle_system.hpp"

#include <cmath>

#include "catch.hpp"
#include "support/mpm_run.hpp"
#include "support/random_states.hpp"

using namespace vitrum;
using namespace vitrum::test;

TEST_CASE("A particle beyond the axis has the mirrored rates of its image", "[integrators][mpm]") {
  for (const char* shape : {"linear", "gimp", "bspline2"}) {
    CAPTURE(shape);
    MpmScene scene;
    scene.geometry = "axisymmetric", scene.shape = shape;
    scene.tables = body("block", box({0.0, 0.0}, {3.0, 3.0}), "particles_per_cell = 4");
    MpmRun run(scene);
    ParticleSystem system(run.system, {1.0, 1e-3, 1.0}, 1e-3, 1.0);
    const std::size_t n = run.particles().size;
    std::vector<double> y(system.size()), f(system.size()), g(system.size());
    system.begin(y.data());
    Random random(31);
    for (std::size_t i = 2 * n; i < 4 * n; ++i) y[i] = random.uniform(-0.1, 0.1);    // velocity
    for (std::size_t i = 4 * n; i < 8 * n; ++i) y[i] = random.uniform(-1e-2, 1e-2);  // strain
    for (std::size_t i = 8 * n; i < 9 * n; ++i) y[i] = random.uniform(-1.0, 1.0);    // turn
    REQUIRE(system.rates(0.1, y.data(), f.data()));
    // The particle nearest to the axis changes places with its image: displacement r, velocity r, strain rz,
    // turn.
    std::size_t i = 0;
    for (std::size_t k = 0; k < n; ++k)
      if (run.particles().position[0][k] < run.particles().position[0][i]) i = k;
    std::vector<double> image = y;
    const std::size_t odd[] = {0, 2, 7, 8};
    for (const std::size_t a : odd) image[a * n + i] = -y[a * n + i];
    image[i] = -2.0 * run.particles().position[0][i] - y[i];
    REQUIRE(system.rates(0.1, image.data(), g.data()));
    for (const std::size_t a : odd) g[a * n + i] = -g[a * n + i];
    double largest = 0.0;
    for (std::size_t k = 0; k < f.size(); ++k) largest = std::max(largest, std::abs(f[k] - g[k]));
    CHECK(largest < 1e-12);
    // And it is a state in which something happens.
    CHECK(std::abs(f[7 * n + i]) > 1e-3);
  }
}

namespace {

/// Two bodies of several parts each, the second one below the first.
MpmScene two_blocks(const char* geometry) {
  MpmScene scene;
  scene.geometry = geometry;
  scene.tables = body("high", box({0.0, 50.0}, {12.0, 80.0}), "particles_per_cell = 1") +
                 body("low", box({0.0, 0.0}, {12.0, 40.0}), "particles_per_cell = 4");
  return scene;
}

}  // namespace

TEST_CASE("The parts of a particle system are all unknowns, each once, and near each other in space",
          "[integrators][mpm][threads]") {
  for (const bool works : {false, true})
    for (const char* geometry : {"axisymmetric", "plane-strain"}) {
      CAPTURE(works, geometry);
      MpmScene scene = two_blocks(geometry);
      if (works) scene.tables += "[gravity]\nacceleration = [0.0, -9.81]\n";
      MpmRun run(scene, 2);
      ParticleSystem system(run.system, {1.0, 1e-3, 1.0}, 1e-3, 1.0);
      std::vector<double> y(system.size(), 0.0);
      system.begin(y.data());
      std::vector<int> met(system.size(), 0);
      std::vector<std::vector<std::size_t>> begins(system.parts());
      system.for_each_range([&](std::size_t part, std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) ++met[i];
        begins[part].push_back(begin);
      });
      CHECK(met == std::vector<int>(system.size(), 1));
      // First the parts of the lower body, from below, although it is the second.
      const Particles &high = run.particles(0), &low = run.particles(1);
      const std::size_t lower = (low.size + 255) / 256,
                        before = (run.system.axisymmetric ? 9 : 8) * high.size;
      REQUIRE(begins.size() == lower + (high.size + 255) / 256);
      double height = -1.0;
      for (std::size_t k = 0; k < lower; ++k) {
        REQUIRE(begins[k].front() >= before);
        const double z = low.position[1][begins[k].front() - before];
        CHECK(z >= height - 8.0);  // within a block any order will do
        height = std::max(height, z);
      }
    }
}

TEST_CASE("What a particle system computes is the same for any number of threads",
          "[integrators][mpm][threads]") {
  for (const char* geometry : {"axisymmetric", "plane-strain"}) {
    std::vector<std::vector<double>> found;
    for (const int threads : {1, 2, 3}) {
      MpmRun run(two_blocks(geometry), threads);
      ParticleSystem system(run.system, {1.0, 1e-3, 1.0}, 1e-3, 1.0);
      std::vector<double> y(system.size()), f(system.size()), w(system.size());
      system.begin(y.data());
      Random random(32);
      const std::size_t arrays = run.system.axisymmetric ? 9 : 8;
      std::size_t first = 0, middle = 0;  // the last body's unknowns, a velocity of the middle of them
      for (const Body& body : run.system.bodies) {
        const std::size_t n = body.particles.size;
        for (std::size_t i = 0; i < 4 * n; ++i) y[first + i] += random.uniform(-0.2, 0.2);
        for (std::size_t i = 4 * n; i < arrays * n; ++i) y[first + i] = random.uniform(-1e-3, 1e-3);
        middle = first + 3 * n + n / 2;
        first += arrays * n;
      }
      // Of those next to the axis some have crossed it, in several parts.
      if (run.system.axisymmetric)
        for (std::size_t i = 0; i < run.particles().size; ++i)
          if (run.particles().position[0][i] < 1.0 && i % 2 == 0) y[i] = -0.7;
      std::vector<double> all;
      const auto keep = [&](const std::vector<double>& values) {
        all.insert(all.end(), values.begin(), values.end());
      };
      // Before and after the commit: errors are judged by the strain of the last step.
      for (const double time : {0.1, 0.2}) {
        REQUIRE(system.rates(time, y.data(), f.data()));
        system.error_weights(w.data());
        ErrorEstimate estimate;
        system.add_errors(f.data(), estimate);
        keep(f), keep(w);
        keep({system.stable_step(time, y.data()), estimate.total, estimate.position, estimate.velocity,
              estimate.strain});
        system.commit(time, y.data());
        keep({run.system.record.kinetic, run.system.record.elastic});
        CHECK(run.system.record.kinetic == Approx(mpm::kinetic_energy(run.system)).epsilon(1e-13));
        for (double& value : y) value *= 1.01;
      }
      // What is not finite is found in any part, and named.
      y[middle] = std::nan("");
      CHECK_FALSE(system.rates(0.3, y.data(), f.data()));
      REQUIRE(system.not_finite());
      keep({static_cast<double>(*system.not_finite())});
      found.push_back(all);
    }
    for (const std::vector<double>& of_threads : found) CHECK(of_threads == found.front());
  }
}
