#include <algorithm>
#include <cmath>
#include <vector>

#include "catch.hpp"
#include "mpm/stress.hpp"
#include "support/mpm_run.hpp"

using namespace vitrum;
using namespace vitrum::test;

// A plate of JH-2 glass in uniaxial strain runs into a wall. Behind the waves that travel into it matter is
// at rest, and the stress is that of Rankine and Hugoniot over the law's own response sigma(eps) to uniaxial
// compression (eps = 1 - V/V0, stress of the present area): waves are as fast as the upper concave envelope
// of sigma is steep, where it follows the curve they are fans, where it is a chord they are shocks, and the
// speed that they take away is the sum of (slope / rho)^(1/2) d eps.

namespace {

constexpr double cell = 0.5e-3;
constexpr int cells = 240;

MaterialParameters glass() {
  const Scene scene = parse_scene(MpmScene{.tables = "[material.glass]\npreset = \"soda-lime, "
                                                     "JH-2\"\n[material.glass.johnson_holmquist]\nC = 0.0\n" +
                                                     body("b", box({0.0, 0.0}, {1.0, 1.0}))}
                                      .text(),
                                  "glass.toml");
  return *std::ranges::find(scene.materials, "glass", &MaterialParameters::name);
}

/// sigma at eps = i * step, Pa, positive in compression.
std::vector<double> response(double step, std::size_t count) {
  const auto material = make_material(glass(), cell);
  PointState s = material->start({});
  std::vector<double> stress{0.0};
  for (std::size_t i = 1; i < count; ++i) {
    const double J0 = 1.0 - step * static_cast<double>(i - 1), J = 1.0 - step * static_cast<double>(i);
    PointReport report;
    material->advance(s, {std::log(J / J0), 0.0, 0.0, 0.0}, 1e-9, report);
    stress.push_back(-s.stress.rr / J);
  }
  return stress;
}

/// Stress behind the waves of a plate that is stopped from `speed`.
double hugoniot(double speed, double density) {
  constexpr double step = 2e-4;
  const std::vector<double> stress = response(step, 2500);
  for (std::size_t last = 1; last < stress.size(); ++last) {
    // The envelope over the points to `last`.
    std::vector<std::size_t> hull;
    for (std::size_t i = 0; i <= last; ++i) {
      const auto slope = [&](std::size_t a, std::size_t b) {
        return (stress[b] - stress[a]) / static_cast<double>(b - a);
      };
      while (hull.size() > 1 && slope(hull[hull.size() - 2], hull.back()) <= slope(hull.back(), i))
        hull.pop_back();
      hull.push_back(i);
    }
    double taken = 0.0;
    for (std::size_t k = 1; k < hull.size(); ++k) {
      const double width = step * static_cast<double>(hull[k] - hull[k - 1]);
      taken += std::sqrt(std::max(stress[hull[k]] - stress[hull[k - 1]], 0.0) * width / density);
    }
    if (taken >= speed) return stress[last];
  }
  return 0.0;
}

}  // namespace

TEST_CASE("plate impact of JH-2 glass: Hugoniot states below and above the elastic limit",
          "[verification][mpm][johnson_holmquist]") {
  for (const double speed : {200.0, 700.0, 1500.0}) {
    const MaterialParameters material = glass();
    MpmScene scene;
    scene.cell = cell, scene.shape = "gimp", scene.scheme = "musl", scene.pace = "courant = 0.2";
    scene.tables =
        "[material.glass]\npreset = \"soda-lime, JH-2\"\n[material.glass.johnson_holmquist]\nC = 0.0\n" +
        hold_everywhere("y") + hold("[-inf, -inf]", "[0, inf]", R"("x", "y")") +
        body("plate", box({0.0, 0.0}, {cells * cell, cell}),
             fmt::format("particles_per_cell = 4\nvelocity = [{}, 0.0]", -speed));
    std::string text = scene.text();
    const std::string made_of = "material = \"elastic\"";
    text.replace(text.find(made_of), made_of.size(), "material = \"glass\"");
    MpmRun run(parse_scene(text, "plate.toml"));
    run.advance(0.6 * cells * cell / 5860.0);
    // Behind the slowest wave, away from the wall.
    const Body& plate = run.system.bodies[0];
    const auto stress = mpm::stress_of(plate);
    const Particles& p = plate.particles;
    double sum = 0.0, velocity = 0.0, count = 0.0;
    for (std::size_t i = 0; i < p.size; ++i)
      if (p.position[0][i] > 5 * cell && p.position[0][i] < 45 * cell) {
        sum -=
            stress[0][i] / std::exp(p.elastic_strain[0][i] + p.elastic_strain[1][i] + p.elastic_strain[2][i]);
        velocity += p.velocity[0][i], count += 1.0;
      }
    const double expected = hugoniot(speed, material.elastic.density);
    CAPTURE(speed, sum / count, expected, velocity / count, run.energy().relative_residual());
    CHECK(std::abs(velocity / count) < 0.03 * speed);
    CHECK(sum / count == Approx(expected).epsilon(0.03));
  }
}
