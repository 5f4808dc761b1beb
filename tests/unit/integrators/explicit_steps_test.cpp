#include <cmath>

#include "catch.hpp"
#include "integrators/grid/explicit.hpp"
#include "support/mpm_run.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

MpmScene resting(const std::string& pace) {
  MpmScene scene;
  scene.pace = pace;
  scene.tables = body("block", box({0.0, 0.0}, {4.0, 4.0}));
  return scene;
}

}  // namespace

TEST_CASE("A fixed step is shortened evenly and meets its targets exactly", "[integrators]") {
  MpmRun run(resting("step = 0.3"));
  std::vector<double> steps;
  run.watch = [&](double step) {
    steps.push_back(step);
    return true;
  };
  REQUIRE(run.advance(1.0));
  CHECK(run.system.time == 1.0);
  REQUIRE(steps.size() == 4);
  for (const double step : steps) CHECK(step == Approx(0.25).epsilon(1e-14));
  // 3 x 0.3 = 0.9 up to rounding: no fourth sliver of a step.
  REQUIRE(run.advance(1.0 + 0.9));
  CHECK(run.system.time == 1.0 + 0.9);
  CHECK(steps.size() == 7);
  const IntegratorCounters& c = run.integrator.state().counters;
  CHECK(c.steps == 7);
  CHECK(c.limited_by_output == 4);
  CHECK(c.step_min == Approx(0.25));
  CHECK(c.step_max == Approx(0.3));
  CHECK(run.system.step_index == 7);
}

TEST_CASE("A fixed step that is interrupted and resumed takes the steps of the uninterrupted run",
          "[integrators]") {
  MpmScene scene = resting("step = 0.3");
  scene.tables += "[gravity]\nacceleration = [0.0, -0.01]\n";
  MpmRun whole(scene), broken(scene);
  whole.advance(5.0);
  int left = 7;
  broken.watch = [&](double) { return --left > 0; };
  REQUIRE_FALSE(broken.advance(5.0));
  CHECK(broken.system.time < 5.0);
  ExplicitIntegrator resumed(StepScheme::usf, 0.3, std::nullopt);
  resumed.restore(broken.integrator.state());
  left = 1000;
  class Silent final : public StepObserver {
    bool step_done(System&, double) override { return true; }
  } silent;
  REQUIRE(resumed.advance(broken.system, 5.0, silent));
  CHECK(broken.system.time == 5.0);
  CHECK(broken.particles().position == whole.particles().position);
  CHECK(broken.particles().velocity == whole.particles().velocity);
  CHECK(resumed.state().counters.steps == whole.integrator.state().counters.steps);
}

TEST_CASE("The observer's refusal of the last step still counts as reaching the target", "[integrators]") {
  MpmRun run(resting("step = 0.5"));
  int left = 2;
  run.watch = [&](double) { return --left > 0; };
  CHECK(run.advance(1.0));
  CHECK(run.system.time == 1.0);
}

TEST_CASE("A Courant step follows the fastest particle and evens out the last two steps", "[integrators]") {
  MpmScene scene = resting("courant = 0.5");
  scene.tables += body("runner", box({100.0, 0.0}, {102.0, 1.0}), "velocity = [3.0, 0.0]");
  MpmRun run(scene);
  // 1/sqrt(2) x h / (c + v) with c = 1, v = 3, halved.
  const double expected = 0.5 / std::sqrt(2.0) / 4.0;
  CHECK(critical_step(run.system, stability_limit(StepScheme::usf)).step == Approx(2.0 * expected));
  CHECK(critical_step(run.system, stability_limit(StepScheme::usf)).body == "runner");
  std::vector<double> steps;
  run.watch = [&](double step) {
    steps.push_back(step);
    return true;
  };
  REQUIRE(run.advance(10.3 * expected));
  CHECK(run.system.time == 10.3 * expected);
  REQUIRE(steps.size() == 11);
  for (std::size_t i = 0; i < 9; ++i) CHECK(steps[i] == Approx(expected));
  CHECK(steps[9] == Approx(0.65 * expected));
  CHECK(steps[10] == Approx(0.65 * expected));
  CHECK(run.integrator.state().counters.limited_by_stability == 9);
  CHECK(run.integrator.state().counters.limited_by_output == 2);
  // USL gets a smaller fraction of the same.
  CHECK(critical_step(run.system, stability_limit(StepScheme::usl)).step ==
        Approx(std::sqrt(2.0) * expected));
}

TEST_CASE("A particle that passes the axis comes back as its mirror image", "[integrators]") {
  for (const char* shape : {"linear", "gimp", "bspline2"})
    for (const char* scheme : {"usf", "musl"}) {
      CAPTURE(shape, scheme);
      MpmScene scene;
      scene.geometry = "axisymmetric", scene.shape = shape, scene.scheme = scheme, scene.pace = "step = 1.0";
      // The nodes' inward velocity carries the particle over the axis, where they stand still, only within a
      // very long step.
      scene.tables = body("grain", box({0.0, 0.0}, {1.0, 1.0}), "velocity = [-30.0, 0.0]");
      MpmRun run(scene);
      const double mass = run.particles().mass[0];
      run.watch = [](double) { return false; };
      run.advance(1.0);
      const Particles& p = run.particles();
      CHECK(p.position[0][0] > 0.0);
      CHECK(std::isfinite(p.position[0][0]));
      CHECK(p.mass[0] == mass);
      CHECK(std::isfinite(p.velocity[0][0]));
    }
}
