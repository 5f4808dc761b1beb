#include <fmt/format.h>

#include "malformed_input.hpp"
#include "mpm/boundary.hpp"
#include "scene/boundary_checks.hpp"
#include "scene/build_system.hpp"
#include "support/mpm_scene.hpp"
#include "support/random_states.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

/// A scene of cell 1 that lasts from 0 to 1 s.
std::vector<std::string> faults_of(const std::string& boundaries) {
  MpmScene scene;
  scene.tables = body("block", box({0.0, 0.0}, {4.0, 4.0})) + boundaries;
  return faults([&] { parse_scene(scene.text(), "s.toml"); });
}

void require_fault(const std::string& boundaries, const std::string& part) {
  const std::vector<std::string> messages = faults_of(boundaries);
  CAPTURE(boundaries);
  REQUIRE(messages.size() == 1);
  INFO(messages[0]);
  CHECK(messages[0].starts_with("s.toml:"));
  CHECK(messages[0].find("key 'boundary.1.velocity': ") != std::string::npos);
  CHECK(messages[0].find("boundary 'table'") != std::string::npos);
  CHECK(messages[0].find(part) != std::string::npos);
}

const std::string table = hold("[-inf, -10]", "[inf, 0]", "\"x\", \"y\"") + "name = \"table\"\n";

}  // namespace

TEST_CASE("Boundaries that contradict each other are an error, unless one has priority", "[scene]") {
  // From the start: nodes in common.
  require_fault(table + hold("[0, -1]", "[1, 1]", "\"y\"", {0.0, -2.0}), "m/s; expected");
  // In the course of the run: the box comes within half a cell of a row that the other holds.
  require_fault(table + hold("[0, 3]", "[1, 5]", "\"y\"", {0.0, -2.6}), "they meet at t = 0.9615 s");
  require_fault(table + hold("[0, 3]", "[1, 5]", "\"x\", \"y\"", {1.0, -20.0}), "they meet at t = 0.125 s");
  for (const std::string& sound :
       {hold("[0, 3]", "[1, 5]", "\"y\"", {0.0, -2.4}),                       // does not get there
        hold("[0, 1]", "[1, 5]", "\"y\"", {0.0, 20.0}),                       // goes away
        hold("[0, 3]", "[1, 5]", "\"y\"", {0.0, -20.0}) + "moves = false\n",  // stays
        hold("[0, 3]", "[1, 5]", "\"y\"", {0.0, -20.0}) + "priority = 1\n",   // is above the other
        hold("[0, -1]", "[1, 1]", "\"y\"", {0.0, -2.0}) + "priority = -1\n",  // is below it
        hold("[0, 0.2]", "[1, 0.8]", "\"y\"", {0.0, 2.0}),                    // has no node
        hold("[0, -1]", "[1, 1]", "\"y\"")})                                  // asks for the same
    CHECK(faults_of(table + sound).empty());
  // Different components do not contradict each other, wherever they are.
  CHECK(faults_of(hold("[-inf, -10]", "[inf, 0]", "\"x\"") +
                  hold("[-inf, -10]", "[inf, 0]", "\"y\"", {0.0, 3.0}))
            .empty());
}

TEST_CASE("When moving boxes meet: the first time at which they hold a node in common", "[scene]") {
  Random random(5);
  Scene scene;
  scene.cell = 0.25, scene.start = -1.0, scene.end = 3.0;
  int met = 0;
  for (int n = 0; n < 500; ++n) {
    BoundaryDefinition a, b;
    for (BoundaryDefinition* d : {&a, &b}) {
      d->fixed = {true, true};
      for (std::size_t c = 0; c < 2; ++c) {
        d->box.min[c] = random.uniform(-3.0, 3.0);
        d->box.max[c] = d->box.min[c] + random.uniform(0.0, 1.5);
      }
    }
    b.velocity = {random.uniform(-2.0, 2.0), random.uniform(-2.0, 2.0)};
    const auto when = contradiction(scene, a, b);
    const auto overlap = [&](double t) {
      for (std::size_t c = 0; c < 2; ++c) {
        const mpm::Boundary box{"", b.box.min, b.box.max, b.fixed, b.velocity, true, scene.start};
        const mpm::Rows of_a = mpm::rows_between(a.box.min[c], a.box.max[c], scene.cell),
                        of_b = box.rows(c, box.shift(c, t, scene.cell), scene.cell);
        if (!of_a.any() || !of_b.any() || of_a.last < of_b.first || of_b.last < of_a.first) return false;
      }
      return true;
    };
    std::optional<double> first;
    for (double t = scene.start; t <= scene.end && !first; t += 1e-4)
      if (overlap(t)) first = t;
    CAPTURE(n, a.box.min, a.box.max, b.box.min, b.box.max, b.velocity);
    if (!first) continue;
    ++met;
    REQUIRE(when);
    CHECK(*when == Approx(*first).margin(2e-4));
  }
  CHECK(met > 50);
}

TEST_CASE("A box without a node is warned of, with the nearest row", "[scene]") {
  const auto warnings_of = [](const std::string& min, const std::string& max) {
    MpmScene scene;
    scene.cell = 0.5;
    scene.tables = body("block", box({0.0, 0.0}, {4.0, 4.0})) + hold(min, max, "\"y\"") + "name = \"die\"\n";
    return boundary_warnings(parse_scene(scene.text(), "s.toml"));
  };
  CHECK(warnings_of("[-inf, 4]", "[inf, 9]").empty());
  CHECK(warnings_of("[-inf, 4]", "[inf, 4]").empty());
  REQUIRE(warnings_of("[-inf, 4.1]", "[inf, 4.3]").size() == 1);
  CHECK(warnings_of("[-inf, 4.1]", "[inf, 4.3]")[0] ==
        "s.toml:18:7: key 'boundary.0.box': boundary 'die' holds no node: no row of nodes lies between y = "
        "4.1 and 4.3 m; the "
        "nearest is at y = 4 m");
  CHECK(warnings_of("[0.2, 0]", "[0.45, 9]")[0].ends_with(
      "no row of nodes lies between x = 0.2 and 0.45 m; the nearest is at x = 0.5 m"));
  CHECK(warnings_of("[0.2, 4.1]", "[0.45, 4.3]").size() == 2);
}

TEST_CASE("A held half-plane mirrors wherever its face lies between two rows of nodes", "[scene]") {
  const auto mirrors = [](const std::string& face) {
    MpmScene scene;
    scene.tables =
        body("block", box({0.0, 0.0}, {4.0, 4.0})) + hold("[-inf, -inf]", "[inf, " + face + "]", "\"y\"");
    return build_system(parse_scene(scene.text(), "s.toml"), 1).grid.boundaries()[0].mirrors;
  };
  for (const char* face : {"0", "0.1", "0.4", "0.6", "0.99"}) {
    CAPTURE(face);
    CHECK(mirrors(face));
  }
  CHECK_FALSE(mirrors("1"));  // then a row of particles stands behind the plane
}
