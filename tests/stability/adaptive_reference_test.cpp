#include <cmath>

#include "catch.hpp"
#include "mpm/stress.hpp"
#include "support/mpm_run.hpp"
#include "vitrum_source_dir.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

Scene scene(const std::string& name, const std::vector<std::string>& overrides) {
  return read_scene(std::string(VITRUM_SOURCE_DIR) + "/studies/" + name, overrides);
}

}  // namespace

TEST_CASE("The reference case under arkode-explicit, order 3, rtol 1e-2, at 200, 400 and 800 m/s",
          "[stability][adaptive][reference]") {
  for (const double speed : {200.0, 400.0, 800.0}) {
    MpmRun run(
        scene("paper/reference.toml",
              {"integrator.method=\"arkode-explicit\"", "integrator.order=3", "integrator.rtol=1e-2",
               fmt::format("body.1.velocity.1={}", -speed), fmt::format("time.start={:g}", -3e-3 / speed)}));
    run.system.time = -3e-3 / speed;
    double growth = 0.0;
    run.watch = [&](double) {
      growth = std::max(growth, run.ledger.growth());
      return true;
    };
    run.advance(150e-6);
    const IntegratorCounters& c = run.integrator.state().counters;
    CAPTURE(speed, growth, run.energy().relative_residual(), c.steps, c.rejected);
    CHECK(growth <= 1.01);
    CHECK(std::abs(run.energy().relative_residual()) <= 0.02);
    CHECK(c.steps <= 3000);
    CHECK(c.limited_by_accuracy > 0);
    CHECK(c.limited_by_stability > 0);
  }
}

TEST_CASE("The reference case under arkode-implicit never gains energy", "[stability][adaptive][reference]") {
  MpmRun run(scene("paper/reference.toml",
                   {"integrator.method=\"arkode-implicit\"", "integrator.order=2", "integrator.rtol=1e-2"}));
  double growth = 0.0;
  run.watch = [&](double) {
    growth = std::max(growth, run.ledger.growth());
    return true;
  };
  run.advance(20e-6);
  CAPTURE(growth, run.energy().relative_residual());
  CHECK(growth <= 1.0 + 1e-6);
  CHECK(run.energy().relative_residual() > 0.0);  // what remaps lose
  CHECK(run.energy().relative_residual() < 0.05);
}

namespace {

/// Root mean square difference of the stresses of all particles, relative.
double stress_difference(const MpmRun& a, const MpmRun& b) {
  double sum = 0.0, scale = 0.0;
  const auto stress_a = mpm::stress_of(a.system.bodies[0]), stress_b = mpm::stress_of(b.system.bodies[0]);
  for (std::size_t k = 0; k < 4; ++k) {
    const auto &s = stress_a[k], &t = stress_b[k];
    for (std::size_t i = 0; i < s.size(); ++i) sum += (s[i] - t[i]) * (s[i] - t[i]), scale += s[i] * s[i];
  }
  return std::sqrt(sum / scale);
}

std::int64_t critical_steps(const MpmRun& run, double duration) {
  return static_cast<std::int64_t>(duration /
                                   critical_step(run.system, stability_limit(StepScheme::musl)).step);
}

}  // namespace

TEST_CASE(
    "Slow loading: the pressed disk takes far fewer implicit steps, and its stress is that of explicit steps",
    "[stability][adaptive][slow]") {
  const std::string coarse = "space.cell=1e-3";
  MpmRun implicit(scene("slow/press.toml", {coarse}));
  MpmRun steps(scene("slow/press.toml", {coarse, "integrator.method=\"explicit\""}));
  implicit.advance(2e-3), steps.advance(2e-3);
  const double difference = stress_difference(steps, implicit);
  const std::int64_t taken = implicit.integrator.state().counters.steps;
  CAPTURE(difference, taken, critical_steps(steps, 2e-3));
  CHECK(difference < 0.01);
  CHECK(20 * taken < critical_steps(steps, 2e-3));
  CHECK(std::abs(implicit.energy().relative_residual()) < 0.01);
}

TEST_CASE("Slow loading: a plate bent to failure breaks alike under implicit and explicit steps",
          "[stability][adaptive][slow]") {
  const std::vector<std::string> small = {"body.0.box.max.0=0.025", "boundary.0.box.min.0=0.025"};
  auto with_explicit = small;
  with_explicit.push_back("integrator.method=\"explicit\"");
  constexpr double duration = 2.5e-3;
  MpmRun implicit(scene("slow/bend.toml", small)), steps(scene("slow/bend.toml", with_explicit));
  implicit.advance(duration), steps.advance(duration);
  const auto localised = [](const MpmRun& run) {
    int count = 0;
    for (const double l : run.system.bodies[0].column("effective_length")) count += l > 0.0 ? 1 : 0;
    return count;
  };
  const double difference = stress_difference(steps, implicit);
  const std::int64_t taken = implicit.integrator.state().counters.steps;
  CAPTURE(difference, taken, critical_steps(steps, duration), localised(implicit), localised(steps));
  CHECK(localised(steps) > 0);
  CHECK(std::abs(localised(implicit) - localised(steps)) <= 2);
  CHECK(difference < 0.01);
  CHECK(20 * taken < critical_steps(steps, duration));
}
