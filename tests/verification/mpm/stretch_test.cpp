// Domains that follow the particles' stretch: bodies drawn to twice their length stay whole.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "mpm/domain.hpp"
#include "mpm/stress.hpp"
#include "support/adaptive_run.hpp"
#include "support/contact_scenes.hpp"
#include "support/mpm_measure.hpp"
#include "support/random_states.hpp"
#include "tests/catch.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

constexpr double length = 8.0, speed = 0.017;  // cells; of the wave speed, as 100 m/s of steel's

/// A bar of metal, yield stress and hardening 0.0011 and 0.011 of its p-wave modulus, held at its foot; its
/// other end, of three cells more, is drawn to twice the length between or pressed to half of it, and moves
/// with it from the start.
MpmScene drawn_bar(const std::string& shape, int per_cell, const std::string& geometry,
                   const Integrator& integrator, bool drawn) {
  MpmScene scene;
  scene.geometry = geometry, scene.shape = shape;
  integrator.choose(scene);
  const double v = drawn ? speed : -speed;
  const bool axis = geometry == "axisymmetric";
  scene.tables =
      body("bar", box({0.0, 0.0}, {2.0, length + 3.0}),
           fmt::format("particles_per_cell = {}\nvelocity = [0, \"={}*min({}/{}, 1)\"]", per_cell, v,
                       axis ? "z" : "y", length)) +
      hold("[-inf, -inf]", "[inf, 0]", axis ? "\"z\"" : "\"y\"") +
      hold("[-inf, 8]", "[inf, inf]", axis ? "\"z\"" : "\"y\"", {0.0, v}) +
      "[material.elastic.von_mises]\nyield = 0.0011\npeak = 1.0\nhardening = 0.011\nsoftening = 0.0\n";
  return scene;
}

struct Found {
  double velocity;  ///< RMS difference from a uniform stretch, of the speed of the end
  double stress;    ///< along the bar: standard deviation, of the mean
  double gap;       ///< largest distance of neighbours along the bar, of what it should be
};

/// Of the particles between the ends.
Found deviations(MpmRun& run, int per_cell, bool drawn) {
  const Particles& p = run.particles();
  const double now = drawn ? 2.0 * length : 0.5 * length, v = drawn ? speed : -speed;
  const TensorColumns stress = mpm::stress_of(run.system.bodies[0]);
  Found found{0.0, 0.0, 0.0};
  double sum = 0.0, squares = 0.0;
  std::vector<double> heights;
  for (std::size_t i = 0; i < p.size; ++i) {
    const double z = p.position[1][i];
    if (z > 0.85 * now) continue;
    heights.push_back(z);
    found.velocity += std::pow((p.velocity[1][i] - v * z / now) / speed, 2);
    sum += stress[1][i], squares += stress[1][i] * stress[1][i];
  }
  const auto count = static_cast<double>(heights.size());
  found.velocity = std::sqrt(found.velocity / count);
  found.stress = std::sqrt(squares * count / (sum * sum) - 1.0);
  std::ranges::sort(heights);
  const double spacing = now / length / std::sqrt(per_cell);
  for (std::size_t i = 1; i < heights.size(); ++i)
    found.gap = std::max(found.gap, (heights[i] - heights[i - 1]) / spacing);
  return found;
}

Found stretched(const MpmScene& scene, int per_cell, bool drawn) {
  MpmRun run(scene);
  run.advance((drawn ? length : 0.5 * length) / speed);
  return deviations(run, per_cell, drawn);
}

}  // namespace

TEST_CASE("A metal bar that is drawn to twice its length, or pressed to half of it, stays whole",
          "[verification][mpm][stretch]") {
  for (const Integrator& integrator : five_integrators)
    for (const char* geometry : {"plane-strain", "axisymmetric"})
      for (const bool drawn : {true, false}) {
        CAPTURE(integrator.name, geometry, drawn);
        const Found found = stretched(drawn_bar("cpgimp", 4, geometry, integrator, drawn), 4, drawn);
        CHECK(found.velocity < (drawn ? 0.15 : 0.2));
        CHECK(found.stress < (drawn ? 0.15 : 0.45));
        CHECK(found.gap < 1.15);
      }
  // Domains that keep their sides part from each other.
  for (const char* geometry : {"plane-strain", "axisymmetric"}) {
    const Found torn = stretched(drawn_bar("gimp", 4, geometry, {"musl"}, true), 4, true);
    CHECK(torn.gap > 1.4);
    CHECK(torn.stress > 1.0);
  }
}

TEST_CASE("A bar that flies apart faster than waves run stretches uniformly to twice its length",
          "[verification][mpm][stretch]") {
  for (const Integrator& integrator : five_integrators)
    for (const int per_cell : {1, 4, 9}) {
      CAPTURE(integrator.name, per_cell);
      MpmScene scene;
      scene.shape = "cpgimp", scene.young = 1e-5;
      integrator.choose(scene);
      scene.tables =
          body("bar", box({0.0, 0.0}, {2.0, length}),
               fmt::format("particles_per_cell = {}\nvelocity_gradient = [[0, 0], [0, 0.005]]", per_cell)) +
          hold("[-inf, -inf]", "[inf, 0]", "\"y\"");
      MpmRun run(scene);
      run.advance(200.0);
      const Particles& p = run.particles();
      for (std::size_t i = 0; i < p.size; ++i) {
        const double y = p.position[1][i];
        if (y > 0.7 * 2.0 * length) continue;  // what the free end has told
        CHECK(p.velocity[1][i] == Approx(0.0025 * y).margin(0.02 * 0.005 * length));
        CHECK(p.domain[1][i] == Approx(std::min(1.0, 1.0 / std::sqrt(per_cell))).epsilon(0.03));
      }
    }
}

TEST_CASE("Domains have the second moments of the squares that particles were, stretched and turned",
          "[mpm][stretch]") {
  Random random(5);
  MpmScene scene;
  scene.shape = "cpgimp";
  scene.tables = body("square", box({0.0, 0.0}, {1.0, 1.0}));
  for (int n = 0; n < 200; ++n) {
    MpmRun run(scene);
    Particles& p = run.particles();
    // Stretched along two axes, in steps, then turned: F = R V with V = exp(e).
    const double turn = random.uniform(-3.0, 3.0), axis = random.uniform(0.0, 3.0);
    const SymmetricTensor e =
        rotate({random.uniform(-0.6, 0.3), random.uniform(-0.6, 0.3), 0.0, 0.0}, rotation_by(axis));
    constexpr int steps = 7;
    for (int k = 0; k < steps; ++k) mpm::add_stretch(p, {}, 0, (1.0 / steps) * e, 0.0);
    for (int k = 0; k < steps; ++k) mpm::add_stretch(p, {}, 0, {}, turn / steps);
    mpm::update_domains(run.system);
    // Second moments by brute force: points of the square, deformed.
    const SymmetricTensor along = rotate(e, {std::cos(axis), -std::sin(axis)});
    const double c = std::cos(axis), s = std::sin(axis), C = std::cos(turn), S = std::sin(turn),
                 a = std::exp(along.rr), b = std::exp(along.zz);
    double moments[2] = {0.0, 0.0};
    constexpr int points = 40;
    for (int i = 0; i < points; ++i)
      for (int j = 0; j < points; ++j) {
        const double x = (i + 0.5) / points - 0.5, y = (j + 0.5) / points - 0.5;
        const double u = a * (c * x + s * y), v = b * (-s * x + c * y);
        const double X = c * u - s * v, Y = s * u + c * v;
        moments[0] += (C * X - S * Y) * (C * X - S * Y), moments[1] += (S * X + C * Y) * (S * X + C * Y);
      }
    for (std::size_t k = 0; k < 2; ++k)  // of a segment of half length l: l^2 / 3
      CHECK(p.domain[k][0] == Approx(std::sqrt(3.0 * moments[k]) / points).epsilon(1e-3));
  }
}

TEST_CASE("Domains end where shape functions do, and are counted; cracks stretch nothing", "[mpm][stretch]") {
  MpmScene scene;
  scene.shape = "cpgimp";
  scene.tables = body("square", box({0.0, 0.0}, {2.0, 1.0})) +
                 "[material.elastic.decohesion]\nopening = 1e-6\nq = 1.0\nmode_ratio = 1.0\n";
  MpmRun run(scene);
  Body& square = run.system.bodies[0];
  std::vector<double>& cracked = square.particles.variables[*square.material->column("effective_length")];
  cracked[1] = 1.0;
  for (std::size_t i = 0; i < 2; ++i)
    mpm::add_stretch(square.particles, cracked, i, {1.0, -9.0, 0.0, 0.0}, 0.0);
  mpm::update_domains(run.system);
  CHECK(square.particles.domain[0] == std::vector<double>{1.0, 0.5});
  CHECK(square.particles.domain[1] == std::vector<double>{1e-3, 0.5});
  CHECK(mpm::overstretched(run.system) == 1);
}

TEST_CASE("Domains of stages keep the order of explicit tables, and steps converge to the same system",
          "[verification][order][stretch]") {
  const auto finished = [](const std::string& method, const std::string& pace) {
    MpmRun run = swinging_body(method, pace, "cpgimp", "plane-strain");
    run.advance(4.0);
    return run;
  };
  const auto fixed = [](double step) { return fmt::format("fixed_step = {:.17g}\nrtol = 1e-12", step); };
  const MpmRun exact = finished("arkode-explicit", "order = 5\n" + fixed(0.02));
  const auto error = [&](const std::string& method, const std::string& pace) {
    return velocity_difference(finished(method, pace), exact);
  };
  const double third = order(error("arkode-explicit", "order = 3\n" + fixed(0.1)),
                             error("arkode-explicit", "order = 3\n" + fixed(0.05)));
  CHECK(third > 2.7);
  const double first = order(error("explicit", "step = 0.02"), error("explicit", "step = 0.01"));
  CHECK(first > 0.8);
}

TEST_CASE("Domains have the same bits for any number of threads", "[mpm][stretch]") {
  for (const char* name : {"musl", "arkode-explicit"}) {
    std::vector<std::vector<double>> domains;
    for (const int threads : {1, 2, 3}) {
      MpmRun run(drawn_bar("cpgimp", 4, "axisymmetric", {name}, true), threads);
      run.advance(0.2 * length / speed);
      domains.push_back(run.particles().domain[1]);
      CHECK(domains.back() == domains.front());
    }
  }
}
