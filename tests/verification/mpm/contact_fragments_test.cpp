// What cracks have cut off a body behaves as bodies do.
#include <cmath>

#include "mpm/contact/contact.hpp"
#include "support/contact_scenes.hpp"
#include "tests/catch.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

/// A bar of 50 mm whose halves fly apart with 5 m/s in the mean, and a plane in its middle that softens.
MpmScene stretched_bar(bool self, const Integrator& integrator) {
  MpmScene scene;
  scene.shape = "gimp", scene.cell = 0.5e-3;
  scene.density = 2500.0, scene.young = 62.5e9, scene.poisson = 0.0;
  integrator.choose(scene);
  scene.tables = fmt::format("[contact]\nmethod = \"bodies\"\nself = {}\n", self) +
                 body("bar", box({-0.025, 0.0}, {0.025, 0.001}),
                      "particles_per_cell = 4\nvelocity_gradient = [[400.0, 0.0], [0.0, 0.0]]") +
                 "[material.elastic.decohesion]\nopening = 1e-6\nq = 1.0\nmode_ratio = 1.0\n";
  return scene;
}

/// The onset of decohesion at 20 MPa in the column of particles right of the middle.
void weaken(MpmRun& run) {
  Body& bar = run.system.bodies[0];
  const auto column = [&](const char* name) -> std::vector<double>& {
    return bar.particles.variables[*bar.material->column(name)];
  };
  for (std::size_t i = 0; i < bar.particles.size; ++i)
    if (std::abs(bar.particles.position[0][i] - 0.125e-3) < 1e-6)
      column("normal_r")[i] = 1.0, column("effective_length")[i] = 0.5e-3,
      column("cohesive_strength")[i] = 20e6;
  run.reopen_ledger();
}

/// Mean velocity of the particles left or right of the crack. left: by identity.
double velocity_of(MpmRun& run, const std::vector<bool>& left, bool of_left) {
  const Particles& p = run.particles();
  double mass = 0.0, momentum = 0.0;
  for (std::size_t i = 0; i < p.size; ++i)
    if (left[p.identity[i]] == of_left) mass += p.mass[i], momentum += p.mass[i] * p.velocity[0][i];
  return momentum / mass;
}

}  // namespace

TEST_CASE("A bar that has broken in two flies apart; its halves meet again and part as two bodies do",
          "[contact]") {
  for (const Integrator& integrator : five_integrators)
    for (const bool self : {true, false}) {
      if (!self && integrator.name != "musl") continue;
      CAPTURE(integrator.name, self);
      MpmRun run(stretched_bar(self, integrator));
      std::vector<bool> left;
      for (const double x : run.particles().position[0]) left.push_back(x < 0.2e-3);  // with the crack
      weaken(run);
      run.advance(30e-6);
      const double apart = velocity_of(run, left, false) - velocity_of(run, left, true);
      INFO("apart " << apart << " residual " << run.energy().relative_residual());
      CHECK(std::abs(total_momentum(run.system)[0]) < 1e-9);
      CHECK(std::abs(run.energy().relative_residual()) < 0.04);
      CHECK(run.energy().contact == 0.0);
      if (!self) {  // one field draws them together again, whatever the crack says
        CHECK(run.system.bodies[0].fragments.empty());
        CHECK(apart < 0.0);
        continue;
      }
      CHECK(apart > 6.0);
      const std::vector<std::int32_t>& fragments = run.system.bodies[0].fragments;
      REQUIRE(fragments.size() == left.size());
      for (std::size_t i = 0; i < left.size(); ++i)
        CHECK((fragments[i] == fragments[0]) == (left[i] == left[0]));
      // Thrown at each other.
      Particles& p = run.particles();
      for (std::size_t i = 0; i < p.size; ++i) p.velocity[0][i] += left[p.identity[i]] ? 60.0 : -60.0;
      run.reopen_ledger();
      const double closing = velocity_of(run, left, true) - velocity_of(run, left, false);
      run.advance(70e-6);
      const double e = (velocity_of(run, left, false) - velocity_of(run, left, true)) / closing;
      INFO("e " << e << " residual " << run.energy().relative_residual());
      CHECK(e == Approx(0.96).margin(0.03));  // of two bars that are two bodies: 0.954 to 0.969
      CHECK(std::abs(run.energy().relative_residual()) < 0.06);
      CHECK(run.energy().contact == 0.0);
      CHECK(run.system.contact->history()[0].least_gap > -0.05 * run.system.cell);
    }
}
