#include <cmath>

#include "catch.hpp"
#include "support/mpm_run.hpp"
#include "vitrum_source_dir.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

MpmRun press(const std::vector<std::string>& settings) {
  MpmRun run(read_scene(VITRUM_SOURCE_DIR "/studies/slow/press.toml", settings));
  for (int output = 1; output <= 4; ++output) run.advance(0.5e-3 * output);
  return run;
}

}  // namespace

TEST_CASE("Slow loading is not cut into phases unless the scene asks for it", "[verification][integrators]") {
  const MpmRun free = press({}), cut = press({"integrator.remap=0.05e-3"});
  CHECK(free.integrator.state().counters.steps < 40);
  CHECK(free.integrator.state().phases == 4);  // one for each output
  CHECK(cut.integrator.state().phases == 40);
  // Nothing moves far: phases make no difference.
  const Particles &a = free.system.bodies[0].particles, &b = cut.system.bodies[0].particles;
  double difference = 0.0, size = 0.0;
  for (std::size_t i = 0; i < a.size; ++i)
    difference += std::pow(a.elastic_strain[1][i] - b.elastic_strain[1][i], 2),
        size += std::pow(b.elastic_strain[1][i], 2);
  CHECK(std::sqrt(difference / size) < 0.01);
}

TEST_CASE("Without a longest phase they end by travel", "[verification][integrators]") {
  // A block flies through 5 cells: phases of a quarter of a cell. It is driven through them: the same.
  for (const bool driven : {false, true}) {
    MpmScene scene;
    scene.method = "arkode-implicit", scene.pace = "rtol = 1e-2";
    scene.tables = body("block", box({0.0, 0.0}, {3.0, 3.0}), driven ? "" : "velocity = [0.5, 0]") +
                   (driven ? hold("[-inf, -inf]", "[inf, inf]", "\"x\"", {0.5, 0.0}) : "");
    MpmRun run(scene);
    run.advance(10.0);
    CAPTURE(driven);
    CHECK(run.integrator.state().phases >= 20);
    CHECK(run.integrator.state().phases <= 21);
  }
}
