// Contact of bodies against what mechanics knows in closed form.
#include <cmath>
#include <map>
#include <numbers>

#include "mpm/contact/contact.hpp"
#include "support/contact_scenes.hpp"
#include "support/random_states.hpp"
#include "tests/catch.hpp"

using namespace vitrum;
using namespace vitrum::test;

TEST_CASE("Two bars touch when they meet, part after the wave has run through them, and exchange velocities",
          "[contact]") {
  for (const char* scheme : {"usf", "musl"}) {
    CAPTURE(scheme);
    MpmScene scene = bars(2e-3, 7.0, -93.0);
    scene.scheme = scheme;
    MpmRun run(scene);
    double first = 0.0, last = 0.0;
    run.watch = [&](double step) {
      if (run.system.record.contact > 0.0) {
        if (first == 0.0) first = run.system.time;
        last = run.system.time + step;
      }
      return true;
    };
    run.advance(45e-6);
    const double e = (mean_velocity(run, 1) - mean_velocity(run, 0)) / 100.0;
    INFO("first " << first << " last " << last << " e " << e << " residual "
                  << run.energy().relative_residual());
    CHECK(first == Approx(20e-6).margin(0.01 * 0.5e-3 / 100.0));
    CHECK(last - first == Approx(10.1e-6).margin(0.2e-6));
    CHECK(e >= 0.96);
    CHECK(std::abs(run.energy().relative_residual()) < 0.005);
    CHECK(run.energy().contact == 0.0);
    CHECK(std::abs(total_momentum(run.system)[0] - (7.0 - 93.0) * 2500.0 * 0.025 * 0.001) < 1e-12);
  }
}

namespace {

/// A bar meets another one askew: it slides, and both turn.
MpmScene askew(const char* method, const char* rtol) {
  MpmScene scene;
  scene.shape = "gimp", scene.cell = 1e-3, scene.method = method, scene.pace = std::string("rtol = ") + rtol;
  scene.density = 2500.0, scene.young = 62.5e9, scene.poisson = 0.2;
  const auto moving = [](double x, double y) { return "particles_per_cell = 4\nvelocity = " + pair({x, y}); };
  scene.tables =
      "[contact]\nmethod = \"bodies\"\nfriction = 0.3\n" +
      body("a", "polygon = [[0.0, 0.0], [0.006, 0.001], [0.005, 0.005], [-0.001, 0.004]]", moving(0.0, 0.0)) +
      body("b", box({0.003, 0.0055}, {0.006, 0.0095}), moving(-20.0, -80.0));
  return scene;
}

}  // namespace

TEST_CASE("Contact keeps energy and momentum under ARKODE to its tolerance, with friction and couples",
          "[contact]") {
  double before = 1.0;
  for (const char* rtol : {"1e-3", "1e-5"}) {
    MpmRun run(askew("arkode-explicit", rtol));
    const std::array<double, 2> momentum = total_momentum(run.system);
    double least_work = 0.0;
    run.watch = [&](double) {
      least_work = std::min(least_work, run.system.record.friction);
      return true;
    };
    run.advance(25e-6);
    INFO(rtol << " residual " << run.energy().relative_residual() << " friction " << run.energy().friction);
    for (std::size_t c = 0; c < 2; ++c)
      CHECK(total_momentum(run.system)[c] == Approx(momentum[c]).epsilon(1e-12));
    CHECK(least_work >= 0.0);
    CHECK(run.energy().friction > 0.005 * run.energy().initial);
    const double residual = std::abs(run.energy().relative_residual());
    CHECK(residual < before);
    before = 0.2 * residual;
  }
}

TEST_CASE(
    "Bodies that meet within a Lagrangian phase feel each other in it: its energy is kept, over remaps too",
    "[contact]") {
  MpmRun run(askew("arkode-implicit", "1e-4\nremap_travel = 0.5"));
  const std::array<double, 2> momentum = total_momentum(run.system);
  run.advance(15e-6);
  const IntegratorState state = run.integrator.state();
  INFO("phases " << state.phases << " residual " << run.energy().residual() << " steps "
                 << state.counters.steps << " newton " << state.counters.newton_iterations);
  CHECK(state.phases > 5);
  CHECK(run.energy().residual() == Approx(0.0).margin(2e-3 * run.energy().initial));
  for (std::size_t c = 0; c < 2; ++c)
    CHECK(total_momentum(run.system)[c] == Approx(momentum[c]).epsilon(1e-5));
  CHECK(run.system.contact->history()[0].impulse[1] < -0.1 * std::abs(momentum[1]));
  CHECK(run.energy().friction > 0.005 * run.energy().initial);
}

TEST_CASE("Bars that begin in touch part as well", "[contact]") {
  MpmRun run(bars(0.0, 0.0, -10.0));
  run.advance(30e-6);
  CHECK(mean_velocity(run, 0) == Approx(-10.0).margin(0.4));
  CHECK(mean_velocity(run, 1) == Approx(0.0).margin(0.4));
}

namespace {

/// Collides two bars at default settings in 24 random frames of reference, from random gaps, with each
/// integrator: restitutions must agree.
void collide_in_frames(double speed) {
  // Of the energy in a frame. usl and the remaps of the implicit method damp; arkode-explicit does as its
  // tolerance lets it.
  const std::map<std::string, double> most_lost{
      {"usf", 0.01},
      {"musl", 0.0125},
      {"usl", 0.05},
      {"arkode-explicit", 0.025},
      {"arkode-implicit",
       speed < 5.0 ? 0.07 : 0.025}};  // positions have a tolerance of cells, whatever the strains
  Random random(29);
  double least = 2.0, greatest = 0.0;
  for (const Integrator& integrator : five_integrators)
    for (int frame = 0; frame < 24; ++frame) {
      const double drift = random.uniform(-speed, speed),
                   gap = random.uniform(0.0, std::min(1e-3, speed * 5e-6));
      CAPTURE(integrator.name, speed, drift, gap);
      MpmScene scene = bars(gap, drift + speed, drift);
      integrator.choose(scene);
      MpmRun run(scene);
      const double momentum = total_momentum(run.system)[0];
      run.advance(gap / speed + 20e-6);
      const double e = (mean_velocity(run, 1) - mean_velocity(run, 0)) / speed;
      least = std::min(least, e), greatest = std::max(greatest, e);
      CHECK(std::abs(run.energy().relative_residual()) < most_lost.at(integrator.name));
      CHECK(total_momentum(run.system)[0] == Approx(momentum).margin(1e-11 * speed));
    }
  INFO(least << " to " << greatest);
  CHECK(greatest - least < 0.03);
  CHECK(least > 0.93);
}

}  // namespace

// What a collision does to two bars depends neither on the frame of reference nor on the integrator.
TEST_CASE("Bars that meet at 1 m/s part alike in 24 frames and five integrators", "[contact]") {
  collide_in_frames(1.0);
}
TEST_CASE("Bars that meet at 10 m/s part alike in 24 frames and five integrators", "[contact]") {
  collide_in_frames(10.0);
}
TEST_CASE("Bars that meet at 100 m/s part alike in 24 frames and five integrators", "[contact]") {
  collide_in_frames(100.0);
}
TEST_CASE("Bars that meet at 400 m/s part alike in 24 frames and five integrators", "[contact]") {
  collide_in_frames(400.0);
}

TEST_CASE("A block that is pressed onto another one slides as Coulomb says", "[contact]") {
  // 10 MPa by the block's weight; the one below is held.
  for (const double friction : {0.0, 0.3}) {
    CAPTURE(friction);
    MpmScene scene;
    scene.shape = "gimp", scene.cell = 1e-3, scene.scheme = "musl", scene.pace = "";
    scene.density = 2500.0, scene.young = 72e9, scene.poisson = 0.0;
    scene.tables =
        fmt::format("[contact]\nmethod = \"bodies\"\nfriction = {}\n", friction) +
        body("base", box({-0.01, -0.004}, {0.03, 0.0}), "particles_per_cell = 4") +
        body("block", box({0.0, 0.0}, {0.01, 0.005}), "particles_per_cell = 4\nvelocity = [50.0, 0.0]") +
        hold("[-inf, -inf]", "[inf, -0.003]", "\"x\", \"y\"") +
        "[gravity]\nacceleration = [0.0, -800000.0]\n";
    MpmRun run(scene);
    double least_work = 0.0;
    run.watch = [&](double) {
      least_work = std::min(least_work, run.system.record.friction);
      return true;
    };
    run.advance(100e-6);
    const double v = mean_velocity(run, 1), m = 2500.0 * 0.01 * 0.005;
    INFO("v " << v << " friction " << run.energy().friction << " loss " << 0.5 * m * (2500.0 - v * v));
    if (friction == 0.0)
      CHECK(v == Approx(50.0).margin(0.001));
    else
      CHECK(v == Approx(50.0 - friction * 800000.0 * 100e-6).margin(0.5));
    CHECK(run.energy().friction == Approx(0.5 * m * (2500.0 - v * v)).epsilon(0.01).margin(1e-2));
    CHECK(least_work >= 0.0);
  }
}

TEST_CASE("A sphere that meets a large block: Hertz's force and duration", "[contact]") {
  MpmScene scene;
  scene.geometry = "axisymmetric", scene.shape = "gimp", scene.cell = 0.5e-3, scene.scheme = "musl";
  scene.pace = "";
  scene.density = 2500.0, scene.young = 72e9, scene.poisson = 0.25;
  scene.tables = "[contact]\nmethod = \"bodies\"\n" +
                 body("glass", box({0.0, -0.02}, {0.02, 0.0}), "particles_per_cell = 4") +
                 "[[body]]\nname = \"ball\"\nmaterial = \"steel\"\nparticles_per_cell = 4\n"
                 "disk = {centre = [0.0, 0.00501], radius = 0.005}\nvelocity = [0.0, -50.0]\n"
                 "[material.steel]\ndensity = 7800.0\nyoung = 195e9\npoisson = 0.25\n";
  MpmRun run(scene);
  const double pi = std::numbers::pi, R = 0.005, v = 50.0;
  // Both are free: the reduced mass.
  const double modulus = 1.0 / ((1.0 - 0.0625) / 72e9 + (1.0 - 0.0625) / 195e9),
               ball = 4.0 / 3.0 * pi * R * R * R * 7800.0, block = pi * 0.02 * 0.02 * 0.02 * 2500.0,
               mass = ball * block / (ball + block), k = 4.0 / 3.0 * modulus * std::sqrt(R);
  const double depth = std::pow(1.25 * mass * v * v / k, 0.4);
  double impulse = 0.0, peak = 0.0, first = 0.0, last = 0.0;
  run.watch = [&](double step) {
    const double now = run.system.contact->history()[0].impulse[1];
    peak = std::max(peak, -2.0 * pi * (now - impulse) / step);
    if (now != impulse) {
      if (first == 0.0) first = run.system.time;
      last = run.system.time;
    }
    impulse = now;
    return true;
  };
  run.advance(24e-6);
  INFO("peak " << peak << " of " << k * std::pow(depth, 1.5) << ", duration " << last - first << " of "
               << 2.943 * depth / v);
  CHECK(peak == Approx(k * std::pow(depth, 1.5)).epsilon(0.02));
  CHECK(last - first == Approx(2.943 * depth / v).epsilon(0.03));
}

TEST_CASE("Newton's cradle: the last of three bars flies on", "[contact]") {
  MpmScene scene = bars(0.0, 0.0, 0.0);
  scene.tables = "[contact]\nmethod = \"bodies\"\n";
  for (int n = 0; n < 3; ++n)
    scene.tables +=
        body(std::string(1, static_cast<char>('a' + n)),
             box({0.012 * n + (n > 0 ? 0.002 : 0.0), 0.0}, {0.012 * (n + 1) + (n > 0 ? 0.002 : 0.0), 0.001}),
             "particles_per_cell = 4\nvelocity = " + pair({n == 0 ? 10.0 : 0.0, 0.0}));
  MpmRun run(scene);
  run.advance(230e-6);
  CHECK(mean_velocity(run, 0) == Approx(0.0).margin(0.6));
  CHECK(mean_velocity(run, 1) == Approx(0.0).margin(0.6));
  CHECK(mean_velocity(run, 2) == Approx(10.0).margin(0.6));
  CHECK(std::abs(run.energy().relative_residual()) < 0.01);
}

TEST_CASE("A cylinder on a slope rolls with two thirds of the acceleration with which it slides",
          "[contact]") {
  // (A sphere would roll with five sevenths: in the plane all that rolls is a cylinder.) c = 1, cells of 1.
  // Its weight comes slowly, so that it does not bounce: while it flies nothing turns it.
  constexpr double g = 1e-4, slope = 0.5, radius = 6.0, rise = 200.0, duration = 400.0;
  for (const bool rolls : {true, false}) {
    CAPTURE(rolls);
    MpmScene scene;
    scene.shape = "gimp", scene.scheme = "musl", scene.pace = "";
    scene.tables =
        fmt::format("[contact]\nmethod = \"bodies\"\nfriction = {}\n", rolls ? 0.5 : 0.0) +
        body("ground", box({-8.0, -4.0}, {24.0, 0.0}), "particles_per_cell = 4") +
        body("cylinder", disk({0.0, radius}, radius), "particles_per_cell = 4") +
        hold("[-inf, -inf]", "[inf, -1.0]", "\"x\", \"y\"") +
        fmt::format("[gravity]\nacceleration = [\"={0} * min(1, t / {2})\", \"=-{1} * min(1, t / {2})\"]\n",
                    g * slope, g, rise);
    MpmRun run(scene);
    run.advance(duration);
    const double v = mean_velocity(run, 1), free = g * slope * (duration - 0.5 * rise);
    INFO(v / free);
    CHECK(v == Approx(rolls ? 2.0 / 3.0 * free : free).epsilon(rolls ? 0.04 : 0.03));
    CHECK(std::abs(run.energy().relative_residual()) < 0.01);
  }
}
