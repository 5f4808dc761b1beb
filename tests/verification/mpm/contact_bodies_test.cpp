// Contact of bodies of any shape: what they must do whatever their places in the cells, their frame of
// reference and the integrator.
#include <cmath>
#include <numbers>

#include "mpm/contact/contact.hpp"
#include "support/contact_scenes.hpp"
#include "support/random_states.hpp"
#include "tests/catch.hpp"
#include "vitrum_source_dir.hpp"

using namespace vitrum;
using namespace vitrum::test;

TEST_CASE("A drop ball leaves the plate again with every shape function", "[contact]") {
  for (const char* shape : {"linear", "gimp", "bspline2"})
    for (const int per_cell : {1, 4}) {
      CAPTURE(shape, per_cell);
      MpmScene scene;
      scene.geometry = "axisymmetric", scene.shape = shape, scene.cell = 1e-3, scene.scheme = "musl";
      scene.pace = "", scene.density = 2500.0, scene.young = 72e9, scene.poisson = 0.25;
      scene.tables =
          "[contact]\nmethod = \"bodies\"\n" +
          body("plate", box({0.0, -0.006}, {0.015, 0.0}), fmt::format("particles_per_cell = {}", per_cell)) +
          fmt::format(
              "[[body]]\nname = \"ball\"\nmaterial = \"steel\"\nparticles_per_cell = {}\n"
              "disk = {{centre = [0.0, 0.00501], radius = 0.005}}\nvelocity = [0.0, -5.0]\n"
              "[material.steel]\ndensity = 7800.0\nyoung = 195e9\npoisson = 0.25\n",
              per_cell);
      MpmRun run(scene);
      const double momentum = total_momentum(run.system)[1];
      run.advance(60e-6);
      INFO("ball " << mean_velocity(run, 1, 1) << " plate " << mean_velocity(run, 0, 1) << " residual "
                   << run.energy().relative_residual());
      // Both are free. Rigid, they would part with e = 1 at 2.1 and -2.9 m/s; the plate keeps some as waves.
      CHECK(mean_velocity(run, 1, 1) > 1.5);
      CHECK(run.energy().contact == 0.0);
      CHECK(std::abs(run.energy().relative_residual()) < 0.03);
      CHECK(total_momentum(run.system)[1] == Approx(momentum).epsilon(1e-11));
    }
}

TEST_CASE("Two disks that meet part alike in any frame, place and direction", "[contact]") {
  // After Sulsky, Chen and Schreyer (1994): elastic disks, c = 1, of twelve cells' radius.
  Random random(41);
  double least = 2.0, greatest = 0.0;
  for (const Integrator& integrator : {Integrator{"usf"}, {"usl"}, {"musl"}, {"arkode-explicit"}})
    for (int frame = 0; frame < 3; ++frame) {
      constexpr double speed = 0.007, radius = 6.0, distance = 2.0 * radius + 0.1;
      const double angle = random.uniform(0.0, 2.0 * std::numbers::pi), x = random.uniform(0.0, 0.5),
                   y = random.uniform(0.0, 0.5);
      const std::array<double, 2> towards{std::cos(angle), std::sin(angle)},
          drift{random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02)};
      CAPTURE(integrator.name, angle, x, y, drift[0], drift[1]);
      MpmScene scene;
      scene.shape = "gimp", scene.cell = 0.5;
      integrator.choose(scene);
      const auto moving = [&](double v) {
        return "particles_per_cell = 4\nvelocity = " +
               pair({drift[0] + v * towards[0], drift[1] + v * towards[1]});
      };
      scene.tables =
          "[contact]\nmethod = \"bodies\"\n" + body("a", disk({x, y}, radius), moving(speed)) +
          body("b", disk({x + distance * towards[0], y + distance * towards[1]}, radius), moving(-speed));
      MpmRun run(scene);
      run.advance(80.0);
      std::array<double, 2> parting{};
      for (const std::size_t c : {0, 1})
        parting[c] = (mean_velocity(run, 1, c) - mean_velocity(run, 0, c)) / (2.0 * speed);
      const double e = parting[0] * towards[0] + parting[1] * towards[1],
                   across = parting[1] * towards[0] - parting[0] * towards[1];
      INFO("e " << e << " across " << across << " residual " << run.energy().relative_residual());
      CHECK(run.energy().contact == 0.0);
      CHECK(std::abs(across) < 0.03);
      CHECK(e > 0.94);
      least = std::min(least, e), greatest = std::max(greatest, e);
    }
  INFO(least << " to " << greatest);
  CHECK(greatest - least < 0.025);  // of six cells' radius: 0.06 (docs/theory/contact.md)
}

TEST_CASE("A disk that meets a plate head-on goes straight back, wherever the two lie in the cells",
          "[contact]") {
  Random random(59);
  for (int repeat = 0; repeat < 12; ++repeat) {
    const int per_cell = repeat % 2 == 0 ? 1 : 4;
    const bool on_a_line = repeat % 3 == 0;  // of the grid, which is its own image there
    const double half = random.uniform(5.0, 15.0), x = on_a_line ? 0.0 : random.uniform(0.0, 1.0),
                 y = random.uniform(0.0, 1.0);
    CAPTURE(per_cell, half, x, y);
    MpmScene scene;
    scene.shape = "gimp", scene.scheme = "musl", scene.pace = "";
    const std::string particles = fmt::format("particles_per_cell = {}\n", per_cell);
    scene.tables = "[contact]\nmethod = \"bodies\"\n" +
                   body("plate", box({x - half, y}, {x + half, y + 5.0}), particles) +
                   body("disk", disk({x, y + 12.1}, 7.0), particles + "velocity = [0.0, -0.01]");
    MpmRun run(scene);
    run.advance(90.0);
    const auto impulse = run.system.contact->history()[0].impulse;
    const double sideways = std::abs(impulse[0] / impulse[1]);
    INFO("sideways " << sideways << " of the impulse " << impulse[1]);
    CHECK(impulse[1] < -0.5);
    CHECK(sideways < (on_a_line ? 1e-9 : 0.003));
  }
}

namespace {

/// A polygon about a place, turned: a bar that may be thinner than a cell, a triangle with sharp corners, a
/// quadrilateral; or a disk.
std::string any_shape(Random& random, double x, double y) {
  const double turn = random.uniform(0.0, 2.0 * std::numbers::pi), w = random.uniform(1.0, 3.5);
  const int kind = static_cast<int>(random.uniform(0.0, 4.0));
  if (kind == 0) return disk({x, y}, w);
  std::vector<std::array<double, 2>> corners;
  if (kind == 1) {
    const double h = random.uniform(0.5, 1.5);
    corners = {{-w, -h}, {w, -h}, {w, h}, {-w, h}};
  } else if (kind == 2) {
    corners = {{-w, -1.0}, {w, -1.0}, {random.uniform(-w, w), random.uniform(0.5, 3.0)}};
  } else {
    corners = {{-2.0, -1.5}, {w, -2.0}, {2.0, random.uniform(0.0, 2.0)}, {-1.0, 2.0}};
  }
  std::string text = "polygon = [";
  for (const auto& [a, b] : corners)
    text += pair({x + a * std::cos(turn) - b * std::sin(turn), y + a * std::sin(turn) + b * std::cos(turn)}) +
            ", ";
  return text + "]";
}

/// Three bodies of two materials that fly, and turn, towards a common place.
MpmScene three_bodies(Random& random, const Integrator& integrator) {
  MpmScene scene;
  scene.shape = "gimp";
  integrator.choose(scene);
  scene.tables = fmt::format("[contact]\nmethod = \"bodies\"\nfriction = {}\n", random.uniform(0.0, 1.0)) +
                 "[material.stiff]\ndensity = 2.0\nyoung = 5.0\npoisson = 0.25\n";
  const double centres[3][2] = {{-5.5, 0.0}, {5.5, 0.0}, {0.0, 8.0}},
               drift[2] = {random.uniform(-0.02, 0.02), random.uniform(-0.02, 0.02)};
  for (std::size_t n = 0; n < 3; ++n) {
    const double x = centres[n][0] + random.uniform(-0.7, 0.7), y = centres[n][1] + random.uniform(-0.7, 0.7),
                 spin = random.uniform(-0.004, 0.004), vx = drift[0] - 0.003 * x,
                 vy = drift[1] - 0.003 * (y - 3.0);
    const int per_cell[] = {1, 4, 4, 9};
    std::string one =
        body(std::string(1, static_cast<char>('a' + n)), any_shape(random, x, y),
             fmt::format("particles_per_cell = {}\nvelocity = {}\nvelocity_gradient = [[0.0, {}], [{}, 0.0]]",
                         per_cell[static_cast<int>(random.uniform(0.0, 4.0))],
                         pair({vx + spin * y, vy - spin * x}), -spin, spin));
    if (random.uniform(0.0, 1.0) < 0.5) one.replace(one.find("\"elastic\""), 9, "\"stiff\"");
    scene.tables += one;
  }
  return scene;
}

/// The least distance of two bodies' particles.
double distance(const Particles& a, const Particles& b) {
  double least = 1e300;
  for (std::size_t i = 0; i < a.size; ++i)
    for (std::size_t j = 0; j < b.size; ++j)
      least = std::min(least,
                       std::hypot(a.position[0][i] - b.position[0][j], a.position[1][i] - b.position[1][j]));
  return least;
}

}  // namespace

TEST_CASE("Three bodies of random shapes meet and part: momentum, energy, friction, nothing passes through",
          "[contact]") {
  Random random(53);
  for (const Integrator& integrator : five_integrators)
    for (int repeat = 0; repeat < (integrator.name == "arkode-implicit" ? 1 : 3); ++repeat) {
      MpmScene scene = three_bodies(random, integrator);
      if (integrator.name == "arkode-explicit") scene.pace = "order = 4";  // order 3: up to a tenth is damped
      CAPTURE(integrator.name, repeat, scene.tables);
      MpmRun run(scene);
      const std::array<double, 2> momentum = total_momentum(run.system);
      double speed = 0.0, least_heat = 0.0;
      for (const Body& b : run.system.bodies)
        for (std::size_t i = 0; i < b.particles.size; ++i)
          speed += b.particles.mass[i] * std::hypot(b.particles.velocity[0][i], b.particles.velocity[1][i]);
      run.watch = [&](double) {
        least_heat = std::min(least_heat, run.system.record.friction);
        return true;
      };
      run.advance(350.0);
      INFO("residual " << run.energy().relative_residual() << " friction " << run.energy().friction
                       << " contact " << run.energy().contact << " of " << run.energy().initial);
      const bool newton = integrator.name == "arkode-implicit";
      for (const std::size_t c : {0, 1})
        CHECK(total_momentum(run.system)[c] == Approx(momentum[c]).margin((newton ? 1e-5 : 1e-11) * speed));
      CHECK(least_heat >= 0.0);
      // USL damps whatever an edge that leaves a node nearly empty takes part in; it makes nothing.
      CHECK(run.energy().relative_residual() > (integrator.name == "usl" ? 0.0 : -0.04));
      CHECK(run.energy().relative_residual() < (integrator.name == "usl" ? 0.6 : 0.04));
      CHECK(std::abs(run.energy().contact) < 1e-3 * run.energy().initial);
      bool touched = false;
      for (std::size_t a = 0; a < 3; ++a)
        for (std::size_t b = 0; b < a; ++b) CHECK(distance(run.particles(a), run.particles(b)) > 0.15);
      for (const auto& pair : run.system.contact->history()) {
        touched = touched || pair.least_gap < 0.0;
        CHECK(pair.least_gap >= -0.5);  // the depth
      }
      CHECK(touched);
    }
}

TEST_CASE("Friction decides where the reference case's plate fails first", "[contact]") {
  // Cells of 0.5 mm, a plate of 30 mm radius, whose rim nothing reaches before.
  for (const double friction : {0.0, 0.3}) {
    CAPTURE(friction);
    const Scene scene =
        read_scene(std::string(VITRUM_SOURCE_DIR) + "/studies/paper/reference.toml",
                   {"space.cell=0.5e-3", "space.shape_functions=\"gimp\"", "contact.method=\"bodies\"",
                    fmt::format("contact.friction={}", friction), "integrator.scheme=\"musl\"",
                    "integrator.courant=0.4", "body.0.box.max=[0.03, 0.005]"});
    MpmRun run(scene);
    const auto column = *run.system.bodies[0].material->column("effective_length");
    double r = 0.0, z = 0.0;
    run.watch = [&](double) {
      const Particles& p = run.particles(0);
      for (std::size_t i = 0; i < p.size; ++i)
        if (p.variables[column][i] > 0.0) r = p.position[0][i], z = p.position[1][i];
      return r == 0.0;
    };
    run.advance(2e-6);
    INFO("t " << run.system.time << " r " << r << " z " << z);
    CHECK(std::abs(run.energy().relative_residual()) < 0.01);
    if (friction == 0.0) {  // at the front, beside the punch's edge: 5 mm + 1.5 h
      CHECK(r == Approx(5.75e-3).margin(0.1e-3));
      CHECK(z > 4.5e-3);
    } else {  // below the punch, where the wave that the back returns first outdoes what still comes down
      CHECK(r < 4e-3);
      CHECK(z < 1.6e-3);
      CHECK(run.system.time > 0.85e-6);  // it has been at the back
    }
  }
}
