// Contact is one law for five integrators: what they make of the same scenes.
#include <cmath>

#include "integrators/grid/critical_step.hpp"
#include "mpm/contact/contact.hpp"
#include "support/contact_scenes.hpp"
#include "support/random_states.hpp"
#include "tests/catch.hpp"

using namespace vitrum;
using namespace vitrum::test;

TEST_CASE("A block that sticks stays where shear alone takes it, in every integrator", "[contact]") {
  // Pressed with 10 MPa and drawn with 5 MPa, loads applied at once: it swings about where it would rest.
  for (const Integrator& integrator : five_integrators) {
    for (const char* friction : {"inf", "0.3"}) {
      CAPTURE(integrator.name, friction);
      MpmScene scene;
      scene.shape = "gimp", scene.cell = 1e-3, scene.density = 2500.0, scene.young = 72e9,
      scene.poisson = 0.2;
      integrator.choose(scene);
      scene.tables = fmt::format("[contact]\nmethod = \"bodies\"\nfriction = {}\n", friction) +
                     body("base", box({-0.003, -0.002}, {0.009, 0.0}), "particles_per_cell = 4") +
                     body("block", box({0.0, 0.0}, {0.006, 0.005}), "particles_per_cell = 4") +
                     hold("[-inf, -inf]", "[inf, -0.001]", "\"x\", \"y\"") +
                     "[gravity]\nacceleration = [400000.0, -800000.0]\n";
      MpmRun run(scene);
      const double start = mass_mean(run.particles(1), run.particles(1).position[0]);
      double least_heat = 0.0, farthest = 0.0;
      run.watch = [&](double) {
        least_heat = std::min(least_heat, run.system.record.friction);
        const double now = mass_mean(run.particles(1), run.particles(1).position[0]);
        farthest = std::max(farthest, now - start);
        return true;
      };
      run.advance(60e-6);
      const double way = mass_mean(run.particles(1), run.particles(1).position[0]) - start;
      INFO("way " << way << " farthest " << farthest << " heat " << run.energy().friction << " residual "
                  << run.energy().residual() << " of " << run.energy().external);
      CHECK(least_heat >= 0.0);
      // (All energy there is swings; usl and the implicit method damp it.)
      CHECK(std::abs(run.energy().residual()) < 0.25 * std::abs(run.energy().external));
      if (std::string(friction) == "inf")
        CHECK(farthest < 4.0 * 5e6 / 30e9 * 0.005);  // twice the strain of shear and bending at rest
      else                                           // (0.4 - 0.3 x 0.8) 1e6 m/s^2
        CHECK(way == Approx(0.5 * 160000.0 * 60e-6 * 60e-6).epsilon(0.12));
    }
  }
}

TEST_CASE("Stiff contact shortens the steps of explicit methods, and they say so", "[contact]") {
  for (const double stiffness : {10.0, 100.0})
    for (const Integrator& integrator : five_integrators) {
      if (stiffness < 100.0 && integrator.name == "arkode-implicit") continue;
      CAPTURE(stiffness, integrator.name);
      MpmScene scene = bars(1e-4, 0.0, -50.0, fmt::format("stiffness = {}\n", stiffness));
      integrator.choose(scene);
      MpmRun run(scene);
      // 2 stiffness n (c/h)^2 for two bars of one material with n x n particles a cell, beside 8 (c/h)^2.
      const double speed = speed_as_stiff(run.system.contact->frequency_squared(0), run.system.cell);
      CHECK(speed == Approx(5000.0 * std::sqrt(0.5 * stiffness)).epsilon(1e-9));
      CHECK(critical_step(run.system, 0.5).touching.empty());
      CHECK(critical_step(run.system, 0.5, Touching::any).touching == "b");
      run.advance(15e-6);
      const IntegratorCounters& c = run.integrator.state().counters;
      CHECK(mean_velocity(run, 0) == Approx(-49.0).margin(1.5));
      CHECK(std::abs(run.energy().relative_residual()) < 0.05);
      if (integrator.name == "arkode-implicit") continue;
      CHECK(c.limited_by_contact > 10);
      CHECK(c.limited_by_stability > 10);
    }
}

TEST_CASE("The bound of contact's frequency is sharp: a third beyond its step energy grows", "[contact]") {
  for (const double part : {1.0, 1.35}) {
    MpmScene scene = bars(0.0, 0.0, -10.0, "stiffness = 100.0\n");
    scene.scheme = "musl", scene.pace = "step = 1.0";
    const double critical = critical_step(MpmRun(scene).system, stability_limit(StepScheme::musl)).step;
    scene.pace = fixed_step(part * critical);
    MpmRun run(scene);
    run.advance(12e-6);
    INFO(part << ": " << run.energy().relative_residual());
    CHECK((std::abs(run.energy().relative_residual()) < 0.03) == (part <= 1.0));
  }
}
