#include "mpm/contact/fragments.hpp"

#include <algorithm>
#include <set>

#include "support/mpm_run.hpp"
#include "tests/catch.hpp"

using namespace vitrum;
using namespace vitrum::test;
using mpm::Fragments;

namespace {

/// 12 x 4 particles of side 1 that can separate.
System bar() {
  MpmScene scene;
  scene.tables = body("bar", box({0.0, 0.0}, {12.0, 4.0}), "particles_per_cell = 1") +
                 "[material.elastic.decohesion]\nopening = 1e-3\nq = 1.0\nmode_ratio = 1.0\n";
  return build_system(parse_scene(scene.text(), "test.toml"), 1);
}

/// Cracks particles in a box of places, open or closed.
void crack(Body& body, std::array<double, 2> min, std::array<double, 2> max, double opening) {
  const auto column = [&](const char* name) -> std::vector<double>& {
    return body.particles.variables[*body.material->column(name)];
  };
  for (std::size_t i = 0; i < body.particles.size; ++i) {
    const double x = body.particles.position[0][i], y = body.particles.position[1][i];
    if (x > min[0] && x < max[0] && y > min[1] && y < max[1])
      column("decohesion")[i] = 1.0, column("opening_n")[i] = opening;
  }
}

std::size_t in_field(const Body& body, std::int32_t field) {
  return static_cast<std::size_t>(std::ranges::count(body.fragments, field));
}

}  // namespace

TEST_CASE("A crack through a body parts it; one that is closed, or ends in it, does not", "[contact]") {
  System system = bar();
  Body& body = system.bodies[0];
  Fragments fragments(body);
  std::int32_t next = 1;
  CHECK_FALSE(fragments.part(body, next));
  crack(body, {4.0, 1.0}, {5.0, 4.0}, 1e-3);  // ends one row above the lower side
  CHECK_FALSE(fragments.part(body, next));
  crack(body, {4.0, 0.0}, {5.0, 1.0}, 0.0);  // the rest is closed
  CHECK_FALSE(fragments.part(body, next));
  CHECK_FALSE(fragments.any());
  crack(body, {4.0, 0.0}, {5.0, 1.0}, 1e-4);
  REQUIRE(fragments.part(body, next));
  CHECK(next == 2);
  // Columns 0 to 3 come off the larger part; that of the crack goes with either.
  CHECK(in_field(body, 0) + in_field(body, 1) == 48);
  CHECK(in_field(body, 0) >= 28);
  CHECK(in_field(body, 1) >= 16);
  for (std::size_t i = 0; i < 48; ++i) {
    const double x = body.particles.position[0][i];
    if (x < 4.0) CHECK(body.field_of(i) == 1);
    if (x > 5.0) CHECK(body.field_of(i) == 0);
  }
  // All but the rows inside of the larger part lie at faces.
  CHECK(std::ranges::is_sorted(fragments.faces()));
  CHECK(fragments.faces().size() < 48);
  CHECK_FALSE(fragments.part(body, next));  // nothing new
  // What has come off may come into pieces in its turn, and a crack that closes joins nothing.
  crack(body, {4.0, 0.0}, {5.0, 4.0}, 0.0);
  crack(body, {8.0, 0.0}, {9.0, 4.0}, 1e-4);
  CHECK(fragments.part(body, next));
  CHECK(std::set(body.fragments.begin(), body.fragments.end()).size() == 3);
}

TEST_CASE("Rubble of less than four particles stays with the piece that it lies at", "[contact]") {
  System system = bar();
  Body& body = system.bodies[0];
  Fragments fragments(body);
  std::int32_t next = 1;
  crack(body, {0.0, 2.0}, {2.0, 3.0}, 1e-3);  // under the corner's two particles
  crack(body, {2.0, 2.0}, {3.0, 4.0}, 1e-3);
  CHECK_FALSE(fragments.part(body, next));
  CHECK(body.fragments.empty());
  // All of a body that is cracked everywhere stays together.
  crack(body, {0.0, 0.0}, {12.0, 4.0}, 1e-3);
  CHECK_FALSE(fragments.part(body, next));
}
