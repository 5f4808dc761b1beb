#include <cmath>

#include "catch.hpp"
#include "materials/batch.hpp"
#include "materials/johnson_cook.hpp"
#include "support/random_states.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

// 4340 steel: Johnson and Cook (1983).
const ElasticParameters elastic{7830.0, 200.0e9, 0.29};
const double G = elastic_moduli(elastic).shear;

JohnsonCookParameters steel(double C, double heat_fraction) {
  JohnsonCookParameters p;
  p.A = 792.0e6, p.B = 510.0e6, p.n = 0.26, p.C = C, p.m = 1.03;
  p.reference_rate = 1.0, p.reference_temperature = 298.0, p.melting_temperature = 1793.0,
  p.temperature = 298.0;
  p.heat_capacity = 477.0, p.heat_fraction = heat_fraction;
  return p;
}

struct Point {
  double stress, plastic_strain, temperature, work;  // equivalent stress, Pa; plastic work, J/m^3
};

/// The equations at a constant rate of equivalent strain, solved for the rate of plastic strain and
/// integrated by Runge and Kutta with steps that resolve its relaxation: q' = 3 G (rate - p'), p' = r0
/// exp((q/q0 - 1)/C).
Point integrated(const JohnsonCookParameters& p, double strain, double rate, int steps) {
  const auto rates = [&](const Point& at) {
    const double T =
        (at.temperature - p.reference_temperature) / (p.melting_temperature - p.reference_temperature);
    const double slow =
        (p.A + p.B * std::pow(at.plastic_strain, p.n)) * (1.0 - (T > 0.0 ? std::pow(T, p.m) : 0.0));
    const double flow = at.stress > slow ? p.reference_rate * std::exp((at.stress / slow - 1.0) / p.C) : 0.0;
    return Point{3.0 * G * (rate - flow), flow,
                 p.heat_fraction / (7830.0 * p.heat_capacity) * at.stress * flow, at.stress * flow};
  };
  const auto moved = [](Point a, const Point& by, double h) {
    a.stress += h * by.stress, a.plastic_strain += h * by.plastic_strain, a.temperature += h * by.temperature;
    a.work += h * by.work;
    return a;
  };
  Point at{0.0, 0.0, p.temperature, 0.0};
  const double h = strain / rate / steps;
  for (int i = 0; i < steps; ++i) {
    const Point a = rates(at), b = rates(moved(at, a, 0.5 * h)), c = rates(moved(at, b, 0.5 * h)),
                d = rates(moved(at, c, h));
    for (const auto& [k, weight] : {std::pair{a, 1.0}, {b, 2.0}, {c, 2.0}, {d, 1.0}})
      at = moved(at, k, weight * h / 6.0);
  }
  return at;
}

/// The law along the same path, its strain a multiple of `direction`.
Point followed(const JohnsonCookParameters& p, const SymmetricTensor& direction, double strain, double rate,
               int steps) {
  const JohnsonCook law(elastic, p, 1.0e-3);
  JohnsonCook::State s;
  s.temperature = p.temperature;
  PointReport report;
  const SymmetricTensor step = (std::sqrt(1.5) * strain / steps / norm(deviator(direction))) * direction;
  for (int i = 0; i < steps; ++i) law.advance(s, step, strain / rate / steps, report);
  return {std::sqrt(1.5) * norm(deviator(law.stress(s))), s.plastic_strain, s.temperature,
          report.dissipation.total()};
}

}  // namespace

TEST_CASE("Johnson-Cook follows an integration of its equations at constant rate",
          "[material][johnson_cook][convergence]") {
  Random random(5);
  for (const double heat_fraction : {0.0, 0.9})
    for (const double rate : {10.0, 1.0e4}) {
      const JohnsonCookParameters p = steel(0.014, heat_fraction);
      const double strain = 0.3;
      const Point exact = integrated(p, strain, rate, 400000);
      CAPTURE(heat_fraction, rate, exact.stress, exact.temperature);
      if (heat_fraction > 0.0) REQUIRE(exact.temperature > 340.0);
      const SymmetricTensor direction = random.direction();
      double previous = 0.0;
      for (const int steps : {50, 100, 200, 400}) {
        const Point at = followed(p, direction, strain, rate, steps);
        const double error = std::abs(at.stress / exact.stress - 1.0) + std::abs(at.work / exact.work - 1.0) +
                             std::abs(at.temperature - exact.temperature) / 100.0;
        CAPTURE(steps, error, previous);
        CHECK(error < 0.5 / steps);
        if (previous > 0.0) CHECK(error < 0.7 * previous);
        previous = error;
      }
    }
}

TEST_CASE("Johnson-Cook without hardening, rate and heat flows at A, whatever the step",
          "[material][johnson_cook]") {
  JohnsonCookParameters p = steel(0.0, 0.0);
  p.B = 0.0;
  for (const int steps : {1, 7, 300}) {
    const Point at = followed(p, {1.0, -1.0, 0.0, 0.5}, 0.1, 1.0e3, steps);
    CHECK(at.stress == Approx(792.0e6).epsilon(1e-12));
    CHECK(at.plastic_strain == Approx(0.1 - 792.0e6 / (3.0 * G)).epsilon(1e-12));
    CHECK(at.work == Approx(792.0e6 * at.plastic_strain).epsilon(1e-12));
  }
}

TEST_CASE("Johnson-Cook: molten metal bears no shear, and heat is the given share of the plastic work",
          "[material][johnson_cook]") {
  JohnsonCookParameters p = steel(0.014, 0.9);
  const JohnsonCook law(elastic, p, 1.0e-3);
  CHECK(law.strength(0.3, 1.0e3, 1793.0) == 0.0);
  CHECK(law.strength(0.3, 1.0e3, 2500.0) == 0.0);
  CHECK(law.strength(0.3, 0.0, 100.0) == law.strength(0.3, 1.0, 298.0));
  JohnsonCook::State s;
  s.temperature = 298.0;
  PointReport report;
  Random random(6);
  double least = 0.0;
  for (int i = 0; i < 3000; ++i) {
    PointReport one;
    law.advance(s, random.uniform(0.0, 0.02) * random.direction(), 1e-6, one);
    least = std::min(least, one.dissipation.total());
    report.dissipation += one.dissipation;
    REQUIRE(std::sqrt(1.5) * norm(deviator(law.stress(s))) <
            1.0001 * law.strength(s.plastic_strain, 1e6, 298.0));
  }
  CHECK(least >= 0.0);
  CHECK(s.temperature - 298.0 == Approx(0.9 * report.dissipation.plastic / (7830.0 * 477.0)).epsilon(1e-10));
  CHECK(s.temperature > 1500.0);
}
