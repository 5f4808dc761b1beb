// Impulses of boundaries and of gravity are the change of momentum, to rounding.
#include <cmath>
#include <numeric>

#include "catch.hpp"
#include "support/mpm_run.hpp"
#include "support/random_states.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

struct Method {
  const char *method, *scheme, *pace;
};
constexpr Method methods[] = {{"explicit", "usf", "courant = 0.3"},
                              {"explicit", "usl", "courant = 0.1"},
                              {"explicit", "musl", "courant = 0.3"},
                              {"arkode-explicit", "usf", "rtol = 1e-2"},
                              {"arkode-explicit", "usf", "order = 4\nfixed_step = 0.1"},
                              {"arkode-implicit", "usf", "rtol = 1e-2\norder = 2"},
                              {"arkode-implicit", "usf", "rtol = 1e-2\nlinear_solver = \"gmres\""}};
constexpr const char* geometries[] = {"plane-strain", "axisymmetric"};

std::string quoted_components(const std::string& geometry, const std::string& which) {
  const bool plane = geometry == "plane-strain";
  std::string list;
  for (const char c : which)
    list += (list.empty() ? "\"" : ", \"") +
            std::string(c == 'r' ? (plane ? "x" : "r")
                        : plane  ? "y"
                                 : "z") +
            '"';
  return list;
}

/// A block of 4 x 3 cells, four particles each, somewhere in the grid, that moves, turns and strains.
MpmScene thrown(const Method& method, const char* geometry, const char* shape, Random& random) {
  MpmScene scene;
  scene.geometry = geometry, scene.shape = shape;
  scene.method = method.method, scene.scheme = method.scheme, scene.pace = method.pace;
  const double left = 6.0 + random.uniform(-0.5, 0.5), low = random.uniform(0.0, 0.8);
  const auto small = [&] { return random.uniform(-0.01, 0.01); };
  scene.tables = body("block", box({left, low}, {left + 4.0, low + 3.0}),
                      fmt::format("particles_per_cell = 4\nvelocity = {}\nvelocity_gradient = [{}, {}]",
                                  pair({0.03, -0.05}), pair({small(), small()}), pair({small(), small()})));
  return scene;
}

double mass_of(const System& system) {
  double sum = 0.0;
  for (const Body& body : system.bodies)
    sum = std::accumulate(body.particles.mass.begin(), body.particles.mass.end(), sum);
  return sum;
}

/// Demands the balance after a run. Radial momentum of a ring is that of no vector: hoop stress and the axis
/// change it as well.
void check_balance(const MpmScene& scene, double duration) {
  INFO(scene.text());
  MpmRun run(scene);
  const std::array<double, 2> before = total_momentum(run.system);
  run.advance(duration);
  const std::array<double, 2> after = total_momentum(run.system);
  const std::vector<double>& impulses = run.system.record.impulses;
  const double mass = mass_of(run.system), moved = 0.1 * mass;  // speeds are some hundredths
  double pushed = 0.0;
  for (std::size_t c = run.system.axisymmetric ? 1 : 0; c < 2; ++c) {
    double impulse = mass * run.system.gravity[c] * duration;
    for (std::size_t k = c; k < impulses.size(); k += 2)
      impulse += impulses[k], pushed += std::abs(impulses[k]);
    CHECK(std::abs(after[c] - before[c] - impulse) < 1e-12 * moved);
  }
  CHECK(pushed > 1e-2 * moved);
}

}  // namespace

TEST_CASE("Impulses of walls and gravity are the change of momentum", "[reactions]") {
  Random random(11);
  for (const Method& method : methods)
    for (const char* geometry : geometries)
      for (const char* shape : {"linear", "gimp", "bspline2"}) {
        MpmScene scene = thrown(method, geometry, shape, random);
        // A floor that rises and holds both components, and a wall that holds one.
        scene.tables += hold("[-inf, -inf]", fmt::format("[inf, {}]", random.uniform(0.0, 0.9)),
                             quoted_components(geometry, "rz"), {0.0, random.uniform(0.0, 0.03)}) +
                        hold(fmt::format("[{}, -inf]", random.uniform(10.0, 11.0)), "[inf, inf]",
                             quoted_components(geometry, "r")) +
                        "[gravity]\nacceleration = [0.0, -0.01]\n";
        check_balance(scene, 5.0);
      }
}

TEST_CASE("Planes of symmetry answer for their images", "[reactions]") {
  Random random(12);
  for (const Method& method : methods)
    for (const char* geometry : geometries)
      for (const char* shape : {"gimp", "bspline2"}) {
        MpmScene scene = thrown(method, geometry, shape, random);
        // Deep boxes that hold one component at rest: a floor, and a wall that the block is thrown against;
        // where they cross, images have images.
        scene.tables += hold("[-inf, -inf]", "[inf, 0.0]", quoted_components(geometry, "z")) +
                        hold("[10.0, -inf]", "[inf, inf]", quoted_components(geometry, "r"));
        check_balance(scene, 5.0);
      }
}

TEST_CASE("Particles that held nodes carry are pushed by who holds them", "[reactions]") {
  Random random(13);
  for (const Method& method : methods)
    for (const char* geometry : geometries)
      for (const char* shape : {"linear", "gimp"}) {
        MpmScene scene = thrown(method, geometry, shape, random);
        // A die that takes the upper half of the block along, and a ram of higher priority within it.
        scene.tables += hold("[-inf, 2.0]", "[inf, 9.0]", quoted_components(geometry, "rz"), {0.0, -0.02}) +
                        hold("[-inf, 3.0]", "[inf, 9.0]", quoted_components(geometry, "rz"), {0.0, -0.03}) +
                        "priority = 1\n";
        check_balance(scene, 4.0);
        // All of it: no node is free.
        scene.tables = body("block", box({6.0, 0.0}, {10.0, 3.0}), "velocity = [0.0, -0.05]") +
                       hold("[-inf, -9.0]", "[inf, 9.0]", quoted_components(geometry, "rz"), {0.0, 0.02}) +
                       "moves = false\n[gravity]\nacceleration = [0.0, -0.01]\n";
        check_balance(scene, 3.0);
      }
}
