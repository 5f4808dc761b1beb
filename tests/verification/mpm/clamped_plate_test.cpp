// A clamped circular plate against Kirchhoff's theory: energy and deflection under pressure, first frequency.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "support/mpm_run.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

// Quadratic splines of nodes held from a place on end, with their slope, half a cell behind it: there the
// plate is clamped. It is thirty times as wide as thick; what it bends by shear is added to Kirchhoff's (5/6
// of the section bear it).
constexpr double first_held = 120.0, radius = first_held + 0.5, thickness = 4.0;
const double stiffness = unit_young * std::pow(thickness, 3) / (12.0 * (1.0 - unit_poisson * unit_poisson));
const double frequency = 10.2158 / (radius * radius) * std::sqrt(stiffness / thickness);  // rad/s, density 1
const double period = 2.0 * std::numbers::pi / frequency;
constexpr double pressure = 1e-7;
const double shear_stiffness = 5.0 / 6.0 * unit_shear * thickness;
const double deflection = pressure * std::pow(radius, 4) / (64.0 * stiffness) +
                          pressure * radius * radius / (4.0 * shear_stiffness);  // of the middle, 0.07 cells
const double energy =
    pressure * pressure *
    (std::pow(radius, 6) / (768.0 * stiffness) + std::pow(radius, 4) / (32.0 * shear_stiffness));

MpmScene plate(const std::string& of_body, const std::string& pressure_text = "") {
  MpmScene scene;
  scene.geometry = "axisymmetric", scene.shape = "bspline2";
  scene.method = "arkode-implicit", scene.pace = fmt::format("rtol = 1e-4\nremap = {}", period / 32.0);
  scene.tables = body("plate", box({0.0, 0.0}, {radius, thickness}), "particles_per_cell = 4\n" + of_body) +
                 hold(fmt::format("[{}, -inf]", first_held), "[inf, inf]", "\"r\", \"z\"");
  if (!pressure_text.empty())
    scene.tables += fmt::format(
        "[[traction]]\nbody = \"plate\"\nbox = {{min = [-inf, {}], max = [inf, {}]}}\npressure = {}\n",
        thickness, thickness, pressure_text);
  return scene;
}

/// Goes on for a time and calls f(from, to, way of the middle at both) whenever particles have moved, which
/// is at the ends of phases.
template <class F>
void follow_middle(MpmRun& run, double start, double duration, F&& f) {
  const auto sinking = [&] {
    const Particles& p = run.system.bodies[0].particles;
    const auto next_to_axis = std::ranges::find(p.identity, 0U) - p.identity.begin();
    return start - p.position[1][static_cast<std::size_t>(next_to_axis)];
  };
  double from = run.system.time, before = sinking();
  run.watch = [&](double) {
    if (!run.system.record.particles_moved) return true;
    const double now = sinking();
    f(from, run.system.time, before, now);
    from = run.system.time, before = now;
    return true;
  };
  run.advance(from + duration);
  run.watch = nullptr;
}

}  // namespace

TEST_CASE("A clamped plate under pressure stores what Kirchhoff's does", "[verification][mpm][plate]") {
  const MpmRun run(plate("relax = true", fmt::format("{}", pressure)));
  CHECK(run.energy().elastic == Approx(energy).epsilon(0.01));
}

TEST_CASE("A clamped plate under pressure sinks as Kirchhoff's, by the implicit method",
          "[verification][mpm][plate]") {
  // The pressure comes within two periods; what still swings then has no mean.
  const double rise = 2.0 * period;
  MpmRun run(plate("", fmt::format("\"={}*(t < {} ? 0.5 - 0.5*cos(pi*t/{}) : 1)\"", pressure, rise, rise)));
  const double start = run.particles().position[1][0];
  run.advance(rise);
  double sum = 0.0, time = 0.0;
  follow_middle(run, start, period, [&](double from, double to, double before, double now) {
    sum += 0.5 * (to - from) * (before + now), time += to - from;
  });
  CHECK(sum / time == Approx(deflection).epsilon(0.01));
}

TEST_CASE("A clamped plate swings at its first frequency", "[verification][mpm][plate]") {
  // Set off with a velocity near to the first mode: the middle is back at its place every half period.
  MpmRun run(plate(fmt::format("velocity = [0, \"=-1e-5*(1 - (r/{})^2)^2\"]", radius)));
  const double start = run.particles().position[1][0];
  double last = 0.0;
  int crossings = 0;
  follow_middle(run, start, 2.2 * period, [&](double from, double to, double before, double now) {
    if (from > 0.0 && before * now <= 0.0) last = from + (to - from) * before / (before - now), ++crossings;
  });
  CHECK(crossings == 4);
  CHECK(2.0 * last / crossings == Approx(period).epsilon(0.01));
}
