// Flaws: the strength of a body is Weibull's, whatever its cells.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "catch.hpp"
#include "materials/scatter.hpp"
#include "scene/input_error.hpp"
#include "scene/write_scene.hpp"
#include "support/law_samples.hpp"
#include "support/mpm_run.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

constexpr double modulus = 7.0, volume = 1e-6;  // of the scatter, m^3

/// A bar of 20 mm x 2 mm that is stretched evenly, before waves from its sides count; one seed a member.
std::string bar(double cell_side, int seed, const std::string& geometry = "plane-strain") {
  return fmt::format(
      "[space]\ngeometry = \"{}\"\ncell = {:.17g}\n[time]\nend = 1.0\n"
      "[integrator]\nmethod = \"explicit\"\nscheme = \"musl\"\nstep = 2e-11\n"
      "[[body]]\nname = \"bar\"\nmaterial = \"glass\"\nbox = {{min = [0.1, 0.0], max = [0.12, 0.002]}}\n"
      "velocity_gradient = [[1e6, 0.0], [0.0, 0.0]]\nvelocity = [-11e4, 0.0]\n"
      "[material.glass]\ndensity = 2500.0\nyoung = 72e9\npoisson = 0.25\n"
      "[material.glass.damage]\ntoughness = 0.83e6\nk = 5e26\nm = 6\nrate = {{fixed = 1000.0}}\n"
      "scatter = {{modulus = {}, volume = {}, seed = {}}}\n"
      "[material.glass.decohesion]\nopening = 5e-6\nmode_ratio = 50.0\n",
      geometry, cell_side, modulus, volume, seed);
}
System members(double cell_side, int seed, const std::string& geometry = "plane-strain") {
  return build_system(parse_scene(bar(cell_side, seed, geometry), "bar.toml"), 1);
}
const std::vector<double>& factors_of(const Body& body) {
  return body.particles.variables[*body.material->column(StrengthScatter::column)];
}

/// Stress at which a point of a strength factor localises in uniaxial strain.
double strength(const Material& material, double factor) {
  PointState s = material.start({});
  value_of(material, s, *material.column(StrengthScatter::column)) = factor;
  PointReport report;
  material.advance(s, {1e-2, 0.0, 0.0, 0.0}, 1e-6, report);
  return value_of(material, s, *material.column("cohesive_strength"));
}
/// Of a bar under uniform strain: of its weakest particle.
double strength(const Body& body) {
  return strength(*body.material, *std::ranges::min_element(factors_of(body)));
}

/// The largest distance between a sample's distribution and a function.
template <class Distribution>
double distance(std::vector<double> sample, const Distribution& expected) {
  std::sort(sample.begin(), sample.end());
  const auto n = static_cast<double>(sample.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < sample.size(); ++i) {
    const double F = expected(sample[i]), k = static_cast<double>(i);
    largest = std::max({largest, F - k / n, (k + 1.0) / n - F});
  }
  return largest;
}
/// The same of two samples.
double distance(const std::vector<double>& a, const std::vector<double>& b) {
  const auto below = [&b](double x) {
    return static_cast<double>(std::ranges::count_if(b, [x](double y) { return y <= x; })) /
           static_cast<double>(b.size());
  };
  double largest = 0.0;
  for (const double x : a)
    largest = std::max(
        largest,
        std::abs(below(x) - static_cast<double>(std::ranges::count_if(a, [x](double y) { return y <= x; })) /
                                static_cast<double>(a.size())));
  return largest;
}

}  // namespace

TEST_CASE("the strength of a bar is distributed alike in two sizes of cells, and as Weibull says",
          "[material][scatter]") {
  std::vector<double> coarse, fine;
  for (int seed = 1; seed <= 200; ++seed) {
    coarse.push_back(strength(members(1e-3, seed).bodies[0]));
    fine.push_back(strength(members(0.25e-3, seed).bodies[0]));
  }
  // Kolmogorov and Smirnov at 5 %: 1.358 sqrt(1/200 + 1/200) between them, 1.358 / sqrt(200) from Weibull's.
  CHECK(distance(coarse, fine) < 0.1358);
  const System one = members(1e-3, 1);
  const double scale = strength(*one.bodies[0].material, 1.0), bar_volume = 0.02 * 0.002;
  const auto weibull = [&](double s) {
    return -std::expm1(-bar_volume / volume * std::pow(s / scale, modulus));
  };
  CHECK(distance(coarse, weibull) < 0.096);
  CHECK(distance(fine, weibull) < 0.096);
  // Without the volume of the cells the two would be 16^(1/7) apart.
  std::vector<double> wrong = fine;
  for (double& s : wrong) s *= std::pow(16.0, -1.0 / modulus);
  CHECK(distance(coarse, wrong) > 0.5);
}

TEST_CASE("a strength factor is that: eq. 7 with k over its m-th power, JH-2 with that T",
          "[material][scatter]") {
  const System one = members(1e-3, 1);
  const Material& glass = *one.bodies[0].material;
  for (const double factor : {0.5, 0.9, 2.0})
    CHECK(strength(glass, factor) == Approx(factor * strength(glass, 1.0)).epsilon(1e-9));
  MaterialParameters weak = glass.parameters();
  weak.damage->k *= std::pow(0.7, -6.0);
  CHECK(strength(*make_material(weak, 1e-3), 1.0) == Approx(strength(glass, 0.7)).epsilon(1e-9));

  RegisteredSample ceramic = registered_samples().at("johnson_holmquist"), weaker = ceramic;
  std::any_cast<JohnsonHolmquistParameters&>(ceramic.values).scatter = StrengthScatter{modulus, volume};
  std::any_cast<JohnsonHolmquistParameters&>(weaker.values).T *= 0.8;  // as LawSample::start
  const RegisteredLaw& law = *find_law("johnson_holmquist");
  const LawSample a = sample_of(law, ceramic), b = sample_of(law, weaker);
  PointState scattered = a.start(), plain = b.start();
  PointReport report;
  for (int i = 0; i < 20; ++i) {
    const SymmetricTensor step = (i < 10 ? -4e-4 : 3e-4) * SymmetricTensor{1.0, 0.2, 0.1, 0.3};
    a.material->advance(scattered, step, 1e-8, report), b.material->advance(plain, step, 1e-8, report);
    REQUIRE(norm(scattered.stress - plain.stress) == 0.0);
    REQUIRE(scattered.variables[0] == plain.variables[0]);
  }
}

TEST_CASE("the ring of a particle is its volume, and a draw is who it is of", "[scene][scatter]") {
  const StrengthScatter scatter{modulus, volume, 3};
  for (const std::string geometry : {"plane-strain", "axisymmetric"}) {
    const System system = members(1e-3, 3, geometry);
    const Particles& p = system.bodies[0].particles;
    for (std::size_t i = 0; i < p.size; ++i) {
      const double ring = geometry == "axisymmetric" ? 2.0 * std::numbers::pi * p.position[0][i] : 1.0;
      REQUIRE(factors_of(system.bodies[0])[i] ==
              Approx(draw_strength_factor(scatter, 1e-6 * ring, 0, i)).epsilon(1e-12));
    }
  }
  CHECK(draw_strength_factor(scatter, 1e-6, 0, 1) != draw_strength_factor(scatter, 1e-6, 1, 0));
  CHECK(draw_strength_factor(scatter, 1e-6, 0, 1) != draw_strength_factor({modulus, volume, 4}, 1e-6, 0, 1));
  CHECK(draw_strength_factor({modulus, 8e-6, 3}, 1e-6, 0, 1) ==
        Approx(std::pow(8.0, 1.0 / modulus) * draw_strength_factor({modulus, 1e-6, 3}, 1e-6, 0, 1)));
}

TEST_CASE("a bar that is drawn breaks first where it is weakest, at that particle's strength",
          "[mpm][scatter]") {
  for (const int seed : {1, 2, 3}) {
    CAPTURE(seed);
    MpmRun run(parse_scene(bar(1e-3, seed), "bar.toml"));
    const Body& body = run.system.bodies[0];
    const std::size_t localised = *body.material->column("effective_length"),
                      borne = *body.material->column("cohesive_strength");
    const auto& lengths = body.particles.variables[localised];
    run.watch = [&](double) { return std::ranges::none_of(lengths, [](double L) { return L > 0.0; }); };
    run.advance(1e-8);
    const auto& factors = factors_of(body);
    const auto weakest = static_cast<std::size_t>(std::ranges::min_element(factors) - factors.begin());
    // (Others that are hardly stronger may break in the same step. A little of the waves from the sides is in
    // what it bears.)
    CHECK(lengths[weakest] > 0.0);
    CHECK(std::ranges::count_if(lengths, [](double L) { return L > 0.0; }) < 4);
    CHECK(body.particles.variables[borne][weakest] ==
          Approx(strength(*body.material, factors[weakest])).epsilon(0.02));
  }
}

TEST_CASE("scatter is stored where it is named, and told where it is wrong", "[scene][scatter]") {
  const std::string text = bar(1e-3, 1);
  const Scene scene = parse_scene(text, "bar.toml");
  CHECK(resolved_toml(scene).find("scatter = {modulus = 7.0, volume = 1e-06, seed = 1}") !=
        std::string::npos);
  CHECK(resolved_toml(parse_scene(resolved_toml(scene), "resolved.toml")) == resolved_toml(scene));
  MaterialParameters plain = scene.materials[0];
  plain.damage->scatter.reset();
  CHECK(!make_material(plain, 1e-3)->column(StrengthScatter::column));
  const auto fault = [&](std::vector<std::string> overrides) {
    try {
      parse_scene(text, "bar.toml", overrides);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(fault({"material.glass.damage.scatter.modulus=0.5"}).find("expected a number in [1, 1000]") !=
        std::string::npos);
  CHECK(fault({"material.glass.damage.scatter={modulus=7}"}).find("volume") != std::string::npos);
  CHECK(fault({"material.glass.decohesion.scatter={modulus=7, volume=1e-9}"}).find("found an unknown key") !=
        std::string::npos);
}
