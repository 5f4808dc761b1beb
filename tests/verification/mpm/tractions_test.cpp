// Tractions (eq. 3): exact resultants, waves, Lame's solutions, and that their work is booked.
#include <algorithm>
#include <cmath>
#include <tuple>

#include "catch.hpp"
#include "mpm/tractions.hpp"
#include "support/mpm_measure.hpp"
#include "support/mpm_run.hpp"
#include "support/random_states.hpp"
#include "support/resultants.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

struct Method {
  const char *method, *scheme, *pace;
};
constexpr Method methods[] = {{"explicit", "usf", "courant = 0.2"},
                              {"explicit", "usl", "courant = 0.1"},
                              {"explicit", "musl", "courant = 0.2"},
                              {"arkode-explicit", "musl", "rtol = 1e-4"},
                              {"arkode-implicit", "musl", "rtol = 1e-4\nremap_travel = 0.02"}};

std::string traction(const std::string& min, const std::string& max, const std::string& load) {
  return fmt::format("[[traction]]\nbody = \"body\"\nbox = {{min = {}, max = {}}}\n{}\n", min, max, load);
}

/// Sum of the nodal forces of a scene whose bodies have no stress, at its start.
std::array<double, 2> resultant(const std::string& geometry, const std::string& shape,
                                const std::string& body_shape, const std::string& loads, int per_cell) {
  MpmScene scene;
  scene.geometry = geometry, scene.shape = shape;
  scene.tables = body("body", body_shape, fmt::format("particles_per_cell = {}", per_cell)) + loads;
  return resultant_of_tractions(scene);
}

}  // namespace

TEST_CASE("Nodal forces add up to the integral of the traction over the surface",
          "[verification][mpm][traction]") {
  Random random(5);
  for (const char* shape : {"linear", "gimp", "bspline2"})
    for (const int per_cell : {1, 4, 9}) {
      CAPTURE(shape, per_cell);
      const double a = 3.0 + random.uniform(0.0, 1.0), b = a + 4.0 + random.uniform(0.0, 1.0),
                   h = 2.0 + random.uniform(0.0, 1.0), low = a + random.uniform(0.1, 1.0),
                   high = b - random.uniform(0.1, 1.0);
      const std::string slab = box({a, 0.0}, {b, h});
      const std::string top_min = fmt::format("[{:.17g}, {:.17g}]", low, h),
                        top_max = fmt::format("[{:.17g}, {:.17g}]", high, h);
      // The part of the top between two radii that no particle knows.
      auto f =
          resultant("axisymmetric", shape, slab, traction(top_min, top_max, "pressure = 0.01"), per_cell);
      CHECK(f[1] == Approx(-0.01 * 0.5 * (high * high - low * low)).epsilon(1e-13));
      CHECK(f[0] == Approx(0.0).margin(1e-15));
      f = resultant("axisymmetric", shape, slab,
                    traction(top_min, top_max, "vector = [\"=2e-3*r^2\", \"=1e-3*r^3 + z\"]"), per_cell);
      CHECK(f[0] == Approx(2e-3 * (std::pow(high, 4) - std::pow(low, 4)) / 4.0).epsilon(1e-13));
      CHECK(f[1] ==
            Approx(1e-3 * (std::pow(high, 5) - std::pow(low, 5)) / 5.0 + h * 0.5 * (high * high - low * low))
                .epsilon(1e-13));
      // All of the surface under pressure: nothing in plane strain, the hoops' share in axisymmetry.
      const std::string all = traction("[-inf, -inf]", "[inf, inf]", "pressure = 0.01");
      f = resultant("plane-strain", shape, slab, all, per_cell);
      CHECK(std::abs(f[0]) + std::abs(f[1]) < 1e-14);
      f = resultant("axisymmetric", shape, slab, all, per_cell);
      CHECK(f[0] == Approx(-0.01 * h * (b - a)).epsilon(1e-13));
      CHECK(f[1] == Approx(0.0).margin(1e-14));
      // Arcs: the upper half of a sphere has the resultant of its equator's disk; a cut cap that of its own.
      const double R = 3.0 + random.uniform(0.0, 1.0), cut = random.uniform(0.2, 2.0);
      for (const double level : {0.0, cut}) {
        f = resultant("axisymmetric", shape, disk({0.0, 0.0}, R),
                      traction(fmt::format("[0, {:.17g}]", level), "[inf, inf]", "pressure = 0.01"),
                      per_cell);
        CHECK(f[1] == Approx(-0.01 * 0.5 * (R * R - level * level)).epsilon(1e-12));
      }
      f = resultant("plane-strain", shape, disk({0.3, 0.7}, R),
                    traction(fmt::format("[-inf, {:.17g}]", 0.7 + cut), "[inf, inf]", "pressure = 0.01"),
                    per_cell);
      CHECK(f[1] == Approx(-0.01 * 2.0 * std::sqrt(R * R - cut * cut)).epsilon(1e-12));
    }
}

TEST_CASE("A step of pressure on a bar's end sends a wave of that pressure",
          "[verification][mpm][traction]") {
  // One-dimensional strain, density and wave speed 1: behind the front the stress is -p and the velocity p.
  constexpr double p = 1e-3;
  for (const Method& method : methods) {
    CAPTURE(method.method, method.scheme);
    MpmScene scene;
    scene.shape = "bspline2", scene.method = method.method, scene.scheme = method.scheme,
    scene.pace = method.pace;
    scene.tables = body("body", box({0.0, 0.0}, {1.0, 80.0}), "particles_per_cell = 4") +
                   hold_everywhere("x") + traction("[-inf, 0]", "[inf, 0]", fmt::format("pressure = {}", p));
    MpmRun run(scene);
    run.advance(50.0);
    const Particles& particles = run.particles();
    double velocity = 0.0, stress = 0.0, ahead = 0.0;
    int count = 0;
    for (std::size_t i = 0; i < particles.size; ++i) {
      const double y = particles.position[1][i];
      if (y > 5.0 && y < 35.0)
        velocity += particles.velocity[1][i], stress += particles.elastic_strain[1][i], ++count;  // modulus 1
      if (y > 65.0) ahead = std::max(ahead, std::abs(particles.velocity[1][i]));
    }
    CHECK(velocity / count == Approx(p).epsilon(0.01));
    CHECK(stress / count == Approx(-p).epsilon(0.01));
    CHECK(ahead < 0.1 * p);
    CHECK(total_momentum(run.system)[1] == Approx(p * 50.0).epsilon(1e-3));
    // The end has gone p t: the work is p times that, and all of it is in the bar.
    CHECK(run.energy().external == Approx(p * p * 50.0).epsilon(0.02));
    CHECK(std::abs(run.energy().relative_residual()) < 0.02);
  }
}

namespace {

/// Error of the hoop strain under an inner pressure in equilibrium, root of the mean square over the wall.
double lame_error(bool sphere, double cells, const std::string& shape, int per_cell) {
  // Lengths in inner radii times `cells`; outer radius twice the inner.
  const double a = cells, b = 2.0 * cells, p = 1e-4, q = std::pow(a / b, sphere ? 3 : 2);
  MpmScene scene;
  scene.geometry = "axisymmetric", scene.shape = shape;
  const std::string more = fmt::format("particles_per_cell = {}\nrelax = true", per_cell),
                    load = fmt::format("pressure = {}", p);
  if (sphere)
    scene.tables =
        body("body", fmt::format("ring = {{centre = [0, 0], inner = {}, outer = {}}}", a, b), more) +
        traction(fmt::format("[0, {}]", -1.01 * a), fmt::format("[{}, {}]", 1.01 * a, 1.01 * a), load);
  else
    scene.tables = body("body", box({a, 0.0}, {b, 2.0}), more) + hold_everywhere("z") +
                   traction(fmt::format("[{}, -inf]", a), fmt::format("[{}, inf]", a), load);
  const MpmRun run(scene);
  const Particles& particles = run.system.bodies[0].particles;
  double sum = 0.0;
  int count = 0;
  for (std::size_t i = 0; i < particles.size; ++i) {
    const double r = std::hypot(particles.position[0][i], sphere ? particles.position[1][i] : 0.0);
    if (r < a + 1.0 || r > b - 1.0) continue;
    const double nu = unit_poisson, E = unit_young;
    const double exact = sphere ? p * q / (E * (1 - q)) * ((1 - 2 * nu) + 0.5 * (1 + nu) * std::pow(b / r, 3))
                                : p * q * (1 + nu) / (E * (1 - q)) * ((1 - 2 * nu) + b * b / (r * r));
    sum += std::pow(particles.elastic_strain[2][i] / exact - 1.0, 2), ++count;
  }
  return std::sqrt(sum / count);
}

}  // namespace

TEST_CASE("Under inner pressure thick walls are strained as Lame says, to the order of a particle's size",
          "[verification][mpm][traction]") {
  // The load stands half a particle inside.
  for (const auto& [sphere, shape, per_cell, bound] :
       {std::tuple{false, "linear", 1, 0.017}, std::tuple{false, "gimp", 1, 0.017},
        std::tuple{false, "bspline2", 4, 0.012}, std::tuple{true, "linear", 4, 0.017},
        std::tuple{true, "bspline2", 9, 0.01}}) {
    CAPTURE(sphere, shape, per_cell);
    const double coarse = lame_error(sphere, 8.0, shape, per_cell),
                 fine = lame_error(sphere, 16.0, shape, per_cell);
    CAPTURE(coarse, fine);
    CHECK(coarse < bound);
    CHECK(fine < 0.62 * coarse);
  }
}

TEST_CASE("The work of tractions is booked, whether they follow or not", "[verification][mpm][traction]") {
  // A cantilever pulled over by a pressure on its side, far enough that it turns.
  for (const Method& method : methods)
    for (const bool follows : {false, true})
      for (const char* gradients : {"nodes", "centroids"}) {
        CAPTURE(method.method, method.scheme, follows, gradients);
        MpmScene scene;
        scene.shape = "bspline2", scene.gradients = gradients;
        scene.method = method.method, scene.scheme = method.scheme, scene.pace = method.pace;
        scene.tables = body("body", box({0.0, 0.0}, {2.0, 10.0}), "particles_per_cell = 4") +
                       hold("[-inf, -inf]", "[inf, 1]", "\"x\", \"y\"") +
                       traction("[0, 5]", "[0, 10]",
                                fmt::format("pressure = \"=1e-4*(1+sin(0.1*t))\"\nfollows = {}", follows));
        MpmRun run(scene);
        run.advance(60.0);
        const EnergyTotals& e = run.energy();
        CHECK(e.external > 0.0);
        // USL loses by itself, the implicit method between its phases.
        const bool loses =
            method.scheme == std::string("usl") || method.method == std::string("arkode-implicit");
        CHECK(std::abs(e.relative_residual()) < (loses ? 0.06 : 0.01));
        double turned = 0.0;
        for (const double turn : run.particles().turn) turned = std::max(turned, std::abs(turn));
        CHECK(turned > 0.005);
      }
}

TEST_CASE("Shear on a face of the grid does the work that its particles get",
          "[verification][mpm][traction]") {
  // Its couples move nodes beyond the face, on which there is next to no mass.
  Random random(17);
  for (const char* shape : {"linear", "gimp", "cpgimp", "bspline2"})
    for (const char* scheme : {"usf", "musl"})  // usl is unstable where nodes are nearly empty
      for (const char* side : {"left", "right", "bottom", "top", "outer"}) {
        CAPTURE(shape, scheme, side);
        MpmScene scene;
        scene.shape = shape, scene.scheme = scheme, scene.pace = "courant = 0.1";
        const double off = random.uniform(0.0, 1.0) < 0.5 ? 0.0 : random.uniform(0.0, 1e-9);
        scene.tables =
            body("body", box({3.0 + off, 2.0 + off}, {11.0 + off, 6.0 + off}), "particles_per_cell = 1") +
            fmt::format("[[traction]]\nbody = \"body\"\nside = \"{}\"\nvector = [1e-4, 1e-4]\n", side);
        MpmRun run(scene);
        run.advance(3.0);
        const EnergyTotals energy = run.energy();
        CHECK(energy.external > 0.0);
        CHECK(std::abs(energy.residual()) < 0.05 * energy.external);
      }
}

TEST_CASE("A pressure that follows turns with a body, a dead one does not", "[verification][mpm][traction]") {
  // A rigidly spinning block under pressure on one side: the force turns, so that its impulse is that of a
  // circular motion.
  for (const Method& method : methods)
    for (const bool follows : {false, true}) {
      CAPTURE(method.method, method.scheme, follows);
      constexpr double w = 0.02, p = 1e-5, side = 4.0, t = 60.0;
      MpmScene scene;
      scene.shape = "bspline2", scene.gradients = "centroids";
      scene.method = method.method, scene.scheme = method.scheme, scene.pace = method.pace;
      scene.tables =
          body("body", box({0.0, 0.0}, {side, side}),
               fmt::format(
                   "particles_per_cell = 4\nvelocity = [{}, {}]\nvelocity_gradient = [[0, {}], [{}, 0]]",
                   0.5 * side * w, -0.5 * side * w, -w, w)) +
          traction("[0, -inf]", "[0, inf]", fmt::format("pressure = {}\nfollows = {}", p, follows));
      MpmRun run(scene);
      run.advance(t);
      const std::array<double, 2> momentum = total_momentum(run.system);
      const double force = p * side;
      CHECK(momentum[0] == Approx(force * (follows ? std::sin(w * t) / w : t)).epsilon(0.02));
      CHECK(momentum[1] ==
            Approx(force * (follows ? (1.0 - std::cos(w * t)) / w : 0.0)).margin(0.02 * force * t));
    }
}
