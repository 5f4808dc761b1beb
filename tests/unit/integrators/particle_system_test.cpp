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
