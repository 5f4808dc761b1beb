#include "catch.hpp"
#include "materials/interval.hpp"
#include "support/literal_damage.hpp"
#include "support/material_samples.hpp"
#include "support/random_states.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {
ElasticParameters elastic_glass(double poisson) {
  return {2500.0, 72.0e9, poisson};
}
DamageLaw glass_law(double poisson = 0.25) {
  return DamageLaw(glass_damage(), elastic_glass(poisson));
}
}  // namespace

TEST_CASE("damaged moduli are eqs. 5, 6 and 8 as printed", "[material][damage]") {
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const double poisson = random.uniform(0.0, 0.45), x = random.uniform(0.0, 0.999);
    const DamageLaw law = glass_law(poisson);
    LiteralDamage literal = literal_glass();
    literal.poisson = poisson;
    const auto expected = literal.moduli(x * 9.0 / 16.0);
    const Moduli found = law.moduli(x);
    CAPTURE(poisson, x);
    // 1 - D cancels in the printed form, which limits the comparison near x = 1.
    const double tolerance = 1e-14 / (1.0 - x);
    REQUIRE(found.bulk == Approx(expected.bulk).epsilon(tolerance));
    REQUIRE(found.shear == Approx(expected.shear).epsilon(tolerance));
    REQUIRE(law.damage(x) == Approx(expected.damage).epsilon(1e-13).margin(1e-15));
    const double bulk = elastic_moduli(elastic_glass(poisson)).bulk;
    REQUIRE(1.0 - law.damage(x) == Approx(found.bulk / bulk).epsilon(1e-13).margin(1e-15));
  }
}

TEST_CASE("damaged moduli at both ends are exact", "[material][damage]") {
  for (const double poisson : {0.0, 0.1, 0.25, 0.4}) {
    const DamageLaw law = glass_law(poisson);
    const Moduli undamaged = elastic_moduli(elastic_glass(poisson));
    CHECK(law.moduli(0.0).bulk == Approx(undamaged.bulk).epsilon(1e-15));
    CHECK(law.moduli(0.0).shear == Approx(undamaged.shear).epsilon(1e-15));
    CHECK(law.moduli(1.0).bulk == 0.0);
    CHECK(law.moduli(1.0).shear == 0.0);
    CHECK(law.damage(1.0) == 1.0);
    // nu_bar -> 0: the last stiffness has G_bar = 1.5 K_bar.
    const Moduli last = law.moduli(1.0 - 1e-9);
    CHECK(last.shear == Approx(1.5 * last.bulk).epsilon(1e-7));
  }
}

TEST_CASE("derivatives of the damaged moduli against finite differences", "[material][damage]") {
  Random random(2);
  for (int i = 0; i < 500; ++i) {
    const double poisson = random.uniform(0.0, 0.45);
    const DamageLaw law = glass_law(poisson);
    const double x = random.uniform(0.01, 0.99), h = 1e-3;
    // Fourth-order central difference.
    const auto difference = [&](auto&& f) {
      return (8.0 * (f(x + h) - f(x - h)) - (f(x + 2.0 * h) - f(x - 2.0 * h))) / (12.0 * h);
    };
    const Moduli slope = law.moduli_derivative(x);
    const double scale = elastic_moduli(elastic_glass(poisson)).bulk;
    REQUIRE(std::abs(slope.bulk - difference([&](double y) { return law.moduli(y).bulk; })) < 1e-7 * scale);
    REQUIRE(std::abs(slope.shear - difference([&](double y) { return law.moduli(y).shear; })) < 1e-7 * scale);
  }
}

TEST_CASE("the shear modulus falls monotonically up to nu = 0.3 but not from nu = 0.4 on",
          "[material][damage]") {
  const auto rises_somewhere = [](double poisson) {
    const DamageLaw law = glass_law(poisson);
    double before = law.moduli(0.0).shear;
    for (int i = 1; i <= 1000; ++i) {
      const double now = law.moduli(i / 1000.0).shear;
      if (now > before) return true;
      before = now;
    }
    return false;
  };
  for (const double poisson : {0.0, 0.1, 0.2, 0.25, 0.3}) CHECK_FALSE(rises_somewhere(poisson));
  for (const double poisson : {0.4, 0.45, 0.49}) CHECK(rises_somewhere(poisson));
}

TEST_CASE("the bulk modulus falls monotonically", "[material][damage]") {
  for (const double poisson : {0.0, 0.25, 0.4, 0.49}) {
    const DamageLaw law = glass_law(poisson);
    for (int i = 1; i <= 1000; ++i) REQUIRE(law.moduli(i / 1000.0).bulk < law.moduli((i - 1) / 1000.0).bulk);
  }
}

TEST_CASE("crack density of eq. 7 and its inverse", "[material][damage]") {
  const DamageLaw law = glass_law();
  CHECK(law.coefficient(1.0) == Approx(4.784028e24).epsilon(1e-6));
  CHECK(law.coefficient(1.0e3) == Approx(4.784028e18).epsilon(1e-6));
  const double C = law.coefficient(1.0e3);
  CHECK(law.target(-1.0e-4, C) == 0.0);
  CHECK(law.target(0.0, C) == 0.0);
  CHECK(law.target(1.0, C) == crack_density_limit);
  for (const double v : {1e-6, 1e-5, 5e-5}) {
    CHECK(law.target(v, C) == Approx(C * std::pow(v, 6.0)).epsilon(1e-13));
    CHECK(law.strain_at(law.target(v, C), C) == Approx(v).epsilon(1e-13));
  }
  // An exponent that is no integer takes another way through the code.
  DamageParameters fractional = glass_damage();
  fractional.m = 5.5;
  const DamageLaw other(fractional, bare_glass().elastic);
  CHECK(other.target(1e-5, 1e20) == Approx(1e20 * std::pow(1e-5, 5.5)).epsilon(1e-13));
}

TEST_CASE("the criterion of intervals holds all that it is within them, and narrows as they do",
          "[material][damage][bifurcation]") {
  Random random(3);
  for (int i = 0; i < 2000; ++i) {
    DamageParameters p = glass_damage();
    p.m = random.logarithmic(1.01, 100.0);
    const DamageLaw law(p, elastic_glass(random.uniform(-0.95, 0.49)));
    const double x = random.uniform(0.0, 1.0), stretch = random.logarithmic(1e-2, 1.0),
                 normal = random.uniform(-1.0, 1.0);
    const double width = random.logarithmic(1e-6, 0.1);
    const Interval crack_density{x, std::min(x + width, 1.0)}, trace{stretch, stretch * (1.0 + width)},
        strain{normal - width, normal + width};
    const Interval bound = law.bifurcation(crack_density, trace, strain);
    double low = bound.high, high = bound.low;
    for (int k = 0; k < 100; ++k) {
      const double value =
          law.bifurcation(random.uniform(crack_density.low, crack_density.high),
                          random.uniform(trace.low, trace.high), random.uniform(strain.low, strain.high));
      low = std::min(low, value), high = std::max(high, value);
    }
    const double rounding = 1e-12 * (1.0 + std::abs(bound.low) + std::abs(bound.high));
    CAPTURE(p.m, x, stretch, normal, width);
    REQUIRE(bound.low <= low + rounding);
    REQUIRE(high <= bound.high + rounding);
    const Interval half = law.bifurcation(Interval(x, 0.5 * (crack_density.low + crack_density.high)),
                                          Interval(stretch, stretch * (1.0 + 0.5 * width)),
                                          Interval(normal - 0.5 * width, normal + 0.5 * width));
    REQUIRE(half.high - half.low <= 0.75 * (bound.high - bound.low) + rounding);
  }
}
