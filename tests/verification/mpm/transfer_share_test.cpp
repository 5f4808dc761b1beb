// space.transfer: how much of what nodes do not see of velocities stays with the particles.
#include <fmt/format.h>

#include <cmath>

#include "catch.hpp"
#include "mpm/transfer.hpp"
#include "mpm/velocity_filter.hpp"
#include "support/mpm_run.hpp"
#include "support/random_states.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

/// An elastic ball that rings after a stretch, flying along its axis.
std::string ball(const std::string& transfer,
                 const std::string& integrator = "method = \"explicit\"\nscheme = \"musl\"\ncourant = 0.3",
                 const std::string& motion = "velocity = [0, 50]\nvelocity_gradient = [[0, 0], [0, 3e4]]") {
  return fmt::format(
      "[space]\ngeometry = \"axisymmetric\"\ncell = 0.5e-3\nshape_functions = \"gimp\"\ntransfer = {}\n"
      "[time]\nend = 5e-6\n[integrator]\n{}\n"
      "[material.m]\ndensity = 2700\nyoung = 70e9\npoisson = 0.33\n"
      "[[body]]\nname = \"ball\"\nmaterial = \"m\"\ndisk = {{centre = [0, 0.00155], radius = 0.0015}}\n"
      "particles_per_cell = 4\n{}\n",
      transfer, integrator, motion);
}

double axial_momentum(const Body& body) {
  double sum = 0.0;
  for (std::size_t i = 0; i < body.particles.size; ++i)
    sum += body.particles.mass[i] * body.particles.velocity[1][i];
  return sum;
}

constexpr const char* integrators[] = {"method = \"explicit\"\nscheme = \"usf\"\ncourant = 0.3",
                                       "method = \"explicit\"\nscheme = \"usl\"\ncourant = 0.2",
                                       "method = \"explicit\"\nscheme = \"musl\"\ncourant = 0.3",
                                       "method = \"arkode-explicit\"\nrtol = 1e-3",
                                       "method = \"arkode-implicit\"\nrtol = 1e-3"};

}  // namespace

TEST_CASE("What nodes do not see of random velocities: momentum keeps, the energy removed is booked",
          "[mpm][transfer]") {
  for (const double flip : {0.0, 0.5, 0.9}) {
    MpmRun run(parse_scene(ball("\"flip\""), "ball.toml"));
    System& system = run.system;
    Body& body = system.bodies[0];
    Random random(3);
    for (auto& column : body.particles.velocity)
      for (double& v : column) v += random.uniform(-10.0, 10.0);
    system.flip = flip;
    mpm::refresh_grid(system);
    const double before = mpm::kinetic_energy(system), momentum = axial_momentum(body);
    REQUIRE(mpm::filter_velocities(system));
    CHECK(axial_momentum(body) == Approx(momentum).epsilon(1e-12));
    CHECK(system.record.filtered > 0.0);
    CHECK(system.record.filtered == Approx(before - mpm::kinetic_energy(system)).epsilon(1e-9));
    // The same again removes less: S is a contraction.
    const double first = system.record.filtered;
    mpm::filter_velocities(system);
    CHECK(system.record.filtered - first < first);
    CHECK(system.record.filtered > first);
  }
}

TEST_CASE("Uniform motion passes the filter of velocities", "[mpm][transfer]") {
  for (const char* integrator : integrators) {
    CAPTURE(integrator);
    MpmRun run(parse_scene(
        ball("\"pic\"", integrator, "velocity = [0, 50]\nperturbation = {amplitude = 0.01, seed = 1}"),
        "ball.toml"));
    run.advance(5e-6);
    CHECK(run.energy().kinetic == Approx(run.energy().initial).epsilon(1e-9));
    CHECK(std::abs(run.energy().filtered) < 1e-12 * run.energy().initial);
  }
}

TEST_CASE("The filter of velocities acts in every integrator, and its account closes",
          "[verification][mpm][transfer]") {
  for (const char* integrator : integrators) {
    CAPTURE(integrator);
    const auto run_with = [&](const std::string& transfer) {
      MpmRun run(parse_scene(ball(transfer, integrator), "ball.toml"));
      const double momentum = axial_momentum(run.system.bodies[0]);
      run.advance(5e-7);
      CHECK(axial_momentum(run.system.bodies[0]) == Approx(momentum).epsilon(1e-9));
      return run.energy();
    };
    const EnergyTotals flip = run_with("\"flip\""), some = run_with("{flip = 0.9}"),
                       pic = run_with("\"pic\"");
    CHECK(flip.filtered == 0.0);
    CHECK(some.filtered > 0.0);
    CHECK(pic.filtered > some.filtered);
    CHECK(pic.kinetic + pic.elastic < flip.kinetic + flip.elastic);
    for (const EnergyTotals& energy : {some, pic})
      CHECK(std::abs(energy.relative_residual()) < std::abs(flip.relative_residual()) + 2e-3);
  }
}

TEST_CASE("The filter of velocities acts in every step: shorter steps lose more",
          "[verification][mpm][transfer]") {
  const auto lost = [](double courant) {
    MpmRun run(parse_scene(
        ball("\"pic\"", fmt::format("method = \"explicit\"\nscheme = \"musl\"\ncourant = {}", courant)),
        "b"));
    run.advance(1e-7);
    return run.energy().filtered;
  };
  CHECK(lost(0.1) > 1.5 * lost(0.4));
}
