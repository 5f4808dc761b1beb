#include <algorithm>
#include <cmath>

#include "catch.hpp"
#include "support/mpm_run.hpp"
#include "support/random_states.hpp"

using namespace vitrum;
using namespace vitrum::test;

// The step limits of the explicit schemes, in cells per pressure wave travel, against the von Neumann
// analysis of a row with one particle a cell at offset xi. With s = sin^2(kh/2) and a = 4 xi (1 - xi): USF
// and MUSL are leapfrog on w^2 = 4 s (1 - a s) c^2/h^2, so the limit is 2 / max w; USL has trace 2 - D and
// determinant 1 - D a s, D = 4 s (c dt/h)^2, so the limit is 1 / sqrt(1 + a).

namespace {

constexpr int cells = 40;

/// Does a body at rest but for velocities of 1e-9 c along each axis that is free keep its energy?
bool keeps_its_energy(const MpmScene& scene, double time) {
  MpmRun run(scene);
  Random random(7);
  for (auto& velocities : run.particles().velocity)
    for (double& v : velocities) v = random.uniform(-1e-9, 1e-9);
  run.reopen_ledger();
  bool grows = false;
  run.watch = [&](double) {
    grows = !(run.ledger.growth() < 50.0);
    return !grows;
  };
  run.advance(time);
  return !grows;
}

/// The same of a bar over 600 steps of length c dt/h = `step`.
bool stable(const std::string& scheme, double xi, double step, bool free_end) {
  MpmScene scene;
  scene.scheme = scheme;
  scene.pace = fixed_step(step);
  // Particles at i + xi between the held node columns 0 and `cells`.
  scene.tables = body("bar", box({xi - 0.5, 0.0}, {cells + xi - 0.5, 1.0})) + hold_everywhere("y") +
                 hold("[-inf, -inf]", "[0, inf]", "\"x\", \"y\"");
  if (!free_end) scene.tables += hold(fmt::format("[{}, -inf]", cells), "[inf, inf]", "\"x\", \"y\"");
  return keeps_its_energy(scene, 600.0 * step);
}

/// Largest stable c dt/h, to 0.2 %.
double measured_limit(const std::string& scheme, double xi, bool free_end = false) {
  double low = 1e-3, high = 4.0;
  while (high / low > 1.002) {
    const double middle = std::sqrt(low * high);
    (stable(scheme, xi, middle, free_end) ? low : high) = middle;
  }
  return std::sqrt(low * high);
}

double leapfrog_limit(double xi) {
  const double a = 4.0 * xi * (1.0 - xi), s = a > 0.5 ? 0.5 / a : 1.0;
  return 2.0 / std::sqrt(4.0 * s * (1.0 - a * s));
}
double stress_last_limit(double xi) {
  return 1.0 / std::sqrt(1.0 + 4.0 * xi * (1.0 - xi));
}

}  // namespace

TEST_CASE("USF and MUSL are stable up to the leapfrog limit of every particle position", "[stability][mpm]") {
  struct Row {
    double xi, limit;
  };
  for (const auto& [xi, limit] : {Row{0.5, 2.0}, Row{0.25, 1.73}, Row{0.1, 1.25}, Row{0.01, 1.02}})
    for (const char* scheme : {"usf", "musl"}) {
      INFO(scheme << ", xi = " << xi);
      CHECK(leapfrog_limit(xi) == Approx(limit).epsilon(0.003));
      const double measured = measured_limit(scheme, xi);
      CAPTURE(measured);
      CHECK(measured == Approx(leapfrog_limit(xi)).epsilon(0.01));
    }
}

TEST_CASE("USL between held ends is stable up to its own lower limit", "[stability][mpm]") {
  struct Row {
    double xi, limit;
  };
  for (const auto& [xi, limit] : {Row{0.5, 0.707}, Row{0.25, 0.756}, Row{0.1, 0.857}, Row{0.01, 0.981}}) {
    CAPTURE(xi);
    CHECK(stress_last_limit(xi) == Approx(limit).epsilon(0.001));
    const double measured = measured_limit("usl", xi);
    CAPTURE(measured);
    CHECK(measured == Approx(stress_last_limit(xi)).epsilon(0.01));
  }
}

TEST_CASE("USL has no limit but zero when a free end's node is nearly empty; USF and MUSL keep theirs",
          "[stability][mpm]") {
  const double at_hundredth = measured_limit("usl", 0.01, true),
               at_ten_thousandth = measured_limit("usl", 0.0001, true);
  CAPTURE(at_hundredth, at_ten_thousandth);
  CHECK(at_hundredth < 0.25);
  CHECK(at_ten_thousandth < 0.025);
  // A node of mass xi m is as stiff as its neighbours: its limit falls as sqrt(xi).
  CHECK(at_hundredth / at_ten_thousandth == Approx(10.0).epsilon(0.1));
  for (const char* scheme : {"usf", "musl"}) {
    const double measured = measured_limit(scheme, 0.01, true);
    CAPTURE(scheme, measured);
    CHECK(measured > 1.0);
  }
}

TEST_CASE("In the plane, particles in the corners of their cells are stable up to 1/sqrt 2 and little beyond",
          "[stability][mpm]") {
  const auto stable_block = [](const char* scheme, double step) {
    MpmScene scene;
    scene.scheme = scheme;
    scene.pace = fixed_step(step);
    constexpr double xi = 0.01;  // particles at (i + xi, j + xi)
    scene.tables = body("block", box({xi - 0.5, xi - 0.5}, {29.5 + xi, 29.5 + xi}));
    return keeps_its_energy(scene, 300.0);
  };
  for (const char* scheme : {"usf", "musl"}) {
    CAPTURE(scheme);
    CHECK(stable_block(scheme, 0.99 * stability_limit(StepScheme::usf)));
    CHECK_FALSE(stable_block(scheme, 1.15 * stability_limit(StepScheme::usf)));
  }
}

TEST_CASE("The critical step that the integrator reports is stable in a row, wherever particles lie",
          "[stability][mpm]") {
  for (const double xi : {0.5, 0.25, 0.1, 0.01, 0.999})
    for (const char* scheme : {"usf", "musl"}) {
      CAPTURE(xi, scheme);
      CHECK(stable(scheme, xi, stability_limit(StepScheme::usf), false));
    }
  CHECK(stable("usl", 0.5, stability_limit(StepScheme::usl), false));
}
