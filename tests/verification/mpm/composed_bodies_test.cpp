// Bodies of several shapes under loads and in contact, and sides that are loaded by name.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "mpm/tractions.hpp"
#include "scene/input_error.hpp"
#include "support/mpm_measure.hpp"
#include "support/mpm_run.hpp"
#include "support/resultants.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

constexpr double pi = std::numbers::pi;

std::string on_side(const std::string& side, const std::string& load) {
  return fmt::format("[[traction]]\nbody = \"body\"\nside = \"{}\"\n{}\n", side, load);
}

/// Sum of the nodal forces of a body without stress.
std::array<double, 2> resultant(const std::string& shape, const std::string& side) {
  MpmScene scene;
  scene.cell = 0.3;
  scene.tables = body("body", shape, "particles_per_cell = 4") + on_side(side, "pressure = 2.0");
  return resultant_of_tractions(scene);
}

}  // namespace

TEST_CASE("A side by name is where the normal says, exactly", "[verification][mpm][traction]") {
  const auto check = [](const std::string& shape, const std::string& side, double x, double y) {
    CAPTURE(shape, side);
    const auto f = resultant(shape, side);
    CHECK(f[0] == Approx(2.0 * x).margin(1e-11));
    CHECK(f[1] == Approx(2.0 * y).margin(1e-11));
  };
  const std::string slab = box({0.1, 0.2}, {4.2, 2.3});
  check(slab, "top", 0.0, -4.1);
  check(slab, "bottom", 0.0, 4.1);
  check(slab, "left", 2.1, 0.0);
  check(slab, "right", -2.1, 0.0);
  check(slab, "outer", 0.0, 0.0);
  // A quarter of a circle, of the disk's and of the hole's: the body is above a hole's lower half.
  const double quarter = std::sqrt(2.0);
  check(disk({2.0, 2.0}, 1.5), "top", 0.0, -1.5 * quarter);
  check(disk({2.0, 2.0}, 1.5), "left", 1.5 * quarter, 0.0);
  const std::string pierced = disk({2.0, 2.0}, 1.5) + "\nhole = {" + disk({2.1, 1.9}, 0.6) + "}";
  check(pierced, "top", 0.0, -(1.5 + 0.6) * quarter);
  check(pierced, "right", -(1.5 + 0.6) * quarter, 0.0);
  check(pierced, "inner", 0.0, 0.0);
  // A roof of 45 degrees is a top; the rest of its sides are left and right.
  check("polygon = [[0, 0], [4, 0], [2, 2]]", "top", 0.0, -4.0);
  // Half a hole: a notch is no hole.
  const std::string notched = slab + "\nhole = {" + disk({2.0, 2.3}, 0.6) + "}";
  check(notched, "outer", 0.0, 0.0);
  CHECK_THROWS_AS(resultant(notched, "inner"), InputError);
}

TEST_CASE("A cylinder that is a disk without a disk widens under inner pressure as Lame says",
          "[verification][mpm][traction]") {
  constexpr double a = 8.0, b = 16.0, p = 1e-4, period = 8.0 * a;
  MpmScene scene;
  scene.shape = "bspline2";
  scene.tables =
      body("body", disk({0.0, 0.0}, b) + "\nhole = {" + disk({0.0, 0.0}, a) + "}", "particles_per_cell = 4") +
      on_side("inner",
              fmt::format("pressure = \"={}*(t<{}?0.5-0.5*cos(pi*t/{}):1)\"", p, 3 * period, 3 * period));
  MpmRun run(scene);
  const Particles start = run.particles();
  std::vector<double> sum(start.size, 0.0);  // of distances over whole breaths
  double time = 0.0;
  run.advance(3 * period);
  run.watch = [&](double step) {
    const Particles& now = run.particles();
    for (std::size_t i = 0; i < now.size; ++i)
      sum[now.identity[i]] += step * std::hypot(now.position[0][i], now.position[1][i]);
    time += step;
    return true;
  };
  run.advance(5 * period);
  double worst = 0.0;
  for (std::size_t i = 0; i < start.size; ++i) {
    const double r = std::hypot(start.position[0][i], start.position[1][i]);
    if (r < a + 1.0 || r > b - 1.0) continue;
    constexpr double q = a * a / (b * b), nu = unit_poisson;
    const double exact = p * q * (1 + nu) / (unit_young * (1 - q)) * ((1 - 2 * nu) * r + b * b / r);
    worst = std::max(worst, std::abs((sum[i] / time - r) / exact - 1.0));
  }
  CAPTURE(worst);
  CHECK(worst < 0.05);
}

TEST_CASE("A ring is a disk without a disk: a ball that hits either has the same of it",
          "[verification][mpm][contact]") {
  const auto ball_after = [](const std::string& target) {
    MpmScene scene;
    scene.shape = "gimp", scene.scheme = "musl";
    scene.tables = "[contact]\nmethod = \"bodies\"\n" + body("target", target, "particles_per_cell = 4") +
                   body("ball", disk({0.2, 14.3}, 4.0), "particles_per_cell = 4\nvelocity = [0.0, -0.02]");
    MpmRun run(scene);
    const auto before = total_momentum(run.system);
    run.advance(40.0);
    const auto after = total_momentum(run.system);
    CHECK(after[1] == Approx(before[1]).epsilon(1e-9));
    const Particles& ball = run.particles(1);
    return std::array<double, 2>{mass_mean(ball, ball.velocity[0]), mass_mean(ball, ball.velocity[1])};
  };
  const auto ring = ball_after("ring = {centre = [0.0, 0.0], inner = 5.0, outer = 10.0}"),
             pierced = ball_after(disk({0.0, 0.0}, 10.0) + "\nhole = {" + disk({0.0, 0.0}, 5.0) + "}");
  CHECK(ring[1] > -0.015);  // it has met
  CHECK(pierced[0] == Approx(ring[0]).margin(1e-6));
  CHECK(pierced[1] == Approx(ring[1]).margin(1e-6));
}
