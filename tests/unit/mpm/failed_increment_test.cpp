#include <cmath>

#include "catch.hpp"
#include "mpm/computation_error.hpp"
#include "support/mpm_run.hpp"

using namespace vitrum;
using namespace vitrum::test;

TEST_CASE("Of several increments of a tile that fail, the first is named with its own strain", "[mpm]") {
  MpmScene scene;
  scene.scheme = "usf", scene.pace = "courant = 0.2";
  scene.tables = body("block", box({0.0, 0.0}, {8.0, 8.0}),
                      "particles_per_cell = 4\nvelocity_gradient = [[0.001, 0.0], [0.0, 0.0]]") +
                 "[constitutive]\nmethod = \"cvode\"\n"
                 "[material.elastic.von_mises]\nyield = 1e-2\npeak = 1e-2\nhardening = 0\nsoftening = 0\n";
  MpmRun run(scene);
  Particles& p = run.particles();
  // In three chunks of the block's only tile.
  for (std::size_t i = 0; i < p.size; ++i)
    if (p.identity[i] == 50 || p.identity[i] == 70 || p.identity[i] == 200)
      p.elastic_strain[0][i] = std::nan("");
  try {
    run.advance(1.0);
    FAIL("the increments should have failed");
  } catch (const PointFailure& failure) {
    CHECK(run.particles(failure.body).identity[failure.particle] == 50);
    CHECK(std::isfinite(failure.increment.rr));
    CHECK(failure.increment.rr > 0.0);
    CHECK(failure.duration > 0.0);
  }
}
