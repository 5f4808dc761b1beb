#include "scene/thread_count.hpp"

#include "catch.hpp"
#include "scene/build_system.hpp"
#include "scene/read_scene.hpp"
#include "support/mpm_scene.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

int threads_of(MpmScene scene, double side, int available) {
  scene.tables += body("block", box({0.0, 0.0}, {side, side}), "particles_per_cell = 4");
  const Scene read = parse_scene(scene.text(), "test.toml");
  return thread_count(read, build_system(read, 1), available);
}

}  // namespace

TEST_CASE("Threads are chosen by what a step computes, and never more than there are", "[scene][threads]") {
  const MpmScene elastic;
  CHECK(threads_of(elastic, 10.0, 8) == 1);
  CHECK(threads_of(elastic, 24.0, 8) == 1);  // 2,304 particles
  CHECK(threads_of(elastic, 26.0, 8) == 2);  // 2,704
  CHECK(threads_of(elastic, 26.0, 1) == 1);
  CHECK(threads_of(elastic, 60.0, 4) == 4);  // 14,400: worth six

  MpmScene wide = elastic;
  wide.shape = "gimp";
  CHECK(threads_of(wide, 18.0, 8) == 2);  // 1,296 particles
  MpmScene flowing = elastic;
  flowing.tables =
      "[material.elastic.von_mises]\nyield = 1.0\npeak = 1.5\nhardening = 1.0\nsoftening = 1.0\n";
  CHECK(threads_of(flowing, 24.0, 8) == 2);
  MpmScene adaptive = elastic;
  adaptive.method = "arkode-explicit", adaptive.pace = "";
  CHECK(threads_of(adaptive, 49.0, 8) == 1);  // 9,604
  CHECK(threads_of(adaptive, 51.0, 8) == 2);  // 10,404
}
