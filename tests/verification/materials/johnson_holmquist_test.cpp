#include <algorithm>
#include <cmath>
#include <vector>

#include "catch.hpp"
#include "materials/batch.hpp"
#include "materials/johnson_holmquist.hpp"
#include "support/random_states.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

// Float glass: Holmquist et al. (1995); K1 = 45.4 GPa, G = 30.4 GPa.
constexpr double K1 = 45.4e9, G = 30.4e9;
const ElasticParameters elastic{2530.0, 9.0 * K1* G / (3.0 * K1 + G),
                                (3.0 * K1 - 2.0 * G) / (6.0 * K1 + 2.0 * G)};

JohnsonHolmquistParameters glass(double beta = 1.0) {
  JohnsonHolmquistParameters p;
  p.A = 0.93, p.N = 0.77, p.B = 0.088, p.M = 0.35, p.fractured_limit = 0.5, p.C = 0.003;
  p.T = 0.15e9, p.HEL = 5.95e9, p.PHEL = 2.92e9, p.D1 = 0.053, p.D2 = 0.85, p.K2 = -138.0e9, p.K3 = 290.0e9;
  p.beta = beta;
  return p;
}

struct Leg {
  SymmetricTensor strain;
  double duration;
};

/// What a path leaves: stress of the reference volume, damage, bulking, stored and dissipated energy, work.
struct Point {
  SymmetricTensor stress;
  double damage = 0.0, bulking = 0.0, stored = 0.0, dissipated = 0.0, work = 0.0;
};

/// The equations as published, with tiny steps: strength with the damage so far, then damage, then bulking.
/// Stresses of the present area; the deviator that of the reference volume over J.
Point integrated(const JohnsonHolmquistParameters& p, const std::vector<Leg>& path, int steps) {
  const double hel = 1.5 * (p.HEL - p.PHEL);
  SymmetricTensor deviatoric{};  // elastic
  double logarithm = 0.0;        // of V/V0
  Point at;
  for (const Leg& leg : path)
    for (int i = 0; i < steps; ++i) {
      const SymmetricTensor d = (1.0 / steps) * deviator(leg.strain);
      logarithm += trace(leg.strain) / steps;
      deviatoric += d;
      const double rate = std::sqrt(2.0 / 3.0) * norm(d) / (leg.duration / steps);
      const double J = std::exp(logarithm), mu = 1.0 / J - 1.0;
      double P = at.bulking + (mu > 0.0 ? K1 * mu + p.K2 * mu * mu + p.K3 * mu * mu * mu : K1 * (1.0 - J));
      if (at.damage < 1.0 && P < 0.0 && P <= -p.T * (1.0 - at.damage)) at.damage = 1.0;
      if (at.damage >= 1.0) P = std::max(P, 0.0);
      const double faster = 1.0 + p.C * std::log(std::max(rate, 1.0));
      const double whole = p.A * std::pow(std::max(P + p.T, 0.0) / p.PHEL, p.N) * faster;
      const double broken =
          P > 0.0 ? std::min(p.B * std::pow(P / p.PHEL, p.M) * faster, p.fractured_limit) : 0.0;
      const double strength = hel * (whole - at.damage * (whole - broken));
      const double q = std::sqrt(1.5) * 2.0 * G * norm(deviatoric) / J;
      double end = q;
      if (q > strength) {
        const double flow = J * (q - strength) / (3.0 * G);
        end = strength;
        const double needed = p.D1 * std::pow(std::max(P + p.T, 0.0) / p.PHEL, p.D2), old = at.damage;
        at.damage = needed > 0.0 ? std::min(1.0, at.damage + flow / needed) : 1.0;
        const double weaker = hel * (whole - at.damage * (whole - broken));
        const double lost = J * J * (strength * strength - weaker * weaker) / (6.0 * G);
        if (at.damage > old && P >= 0.0) {
          const double x = K1 * (1.0 - J) + at.bulking;
          at.bulking += std::sqrt(x * x + 2.0 * p.beta * K1 * std::max(lost, 0.0)) - x;
        }
      }
      if (q > 0.0) deviatoric *= end / q;
      const SymmetricTensor stress = 2.0 * G * deviatoric - J * P * identity();
      at.work += 0.5 / steps * contract(at.stress + stress, leg.strain);
      at.stress = stress;
    }
  return at;
}

Point followed(const JohnsonHolmquistParameters& p, const std::vector<Leg>& path, int steps) {
  const JohnsonHolmquist law(elastic, p, 1.0e-3);
  JohnsonHolmquist::State s;
  Point at;
  double least = 0.0;
  for (const Leg& leg : path)
    for (int i = 0; i < steps; ++i) {
      PointReport report;
      law.advance(s, (1.0 / steps) * leg.strain, leg.duration / steps, report);
      least = std::min(least, report.dissipation.total());
      at.dissipated += report.dissipation.total();
      at.work += 0.5 / steps * contract(at.stress + law.stress(s), leg.strain);
      at.stress = law.stress(s);
    }
  CHECK(least >= 0.0);
  at.damage = s.damage, at.bulking = s.bulking, at.stored = law.stored_energy(s);
  return at;
}

constexpr SymmetricTensor uniaxial(double strain) {
  return {0.0, strain, 0.0, 0.0};
}

}  // namespace

TEST_CASE("JH-2: the published constants of float glass agree with each other",
          "[material][johnson_holmquist]") {
  const JohnsonHolmquist law(elastic, glass(), 1.0e-3);
  CHECK(law.elastic().bulk == Approx(K1).epsilon(1e-12));
  CHECK(law.elastic().shear == Approx(G).epsilon(1e-12));
  // Elastic uniaxial strain to PHEL reaches HEL: P + 4/3 G mu/(1 + mu).
  double mu = 0.08;
  for (int i = 0; i < 50; ++i)
    mu -= (mu * (K1 + mu * (-138.0e9 + mu * 290.0e9)) - 2.92e9) / (K1 - 2.0 * 138.0e9 * mu);
  CHECK(2.92e9 + 4.0 / 3.0 * G * mu / (1.0 + mu) == Approx(5.95e9).epsilon(2e-3));
}

TEST_CASE("JH-2 follows an integration of its equations: compression and release, shear, tension",
          "[material][johnson_holmquist][convergence]") {
  const double rate = 1.0e5;
  const auto leg = [rate](const SymmetricTensor& strain) { return Leg{strain, norm(strain) / rate}; };
  const std::vector<std::vector<Leg>> paths = {
      {leg(uniaxial(-0.07))},                                                // elastic still
      {leg(uniaxial(-0.11))},                                                // damaging
      {leg(uniaxial(-0.25)), leg(uniaxial(0.2)), leg(uniaxial(0.1))},        // fractured, released, pulled
      {leg(uniaxial(-0.25)), leg(uniaxial(0.25)), leg(uniaxial(-0.2))},      // and compressed again
      {leg({-0.01, -0.01, -0.01, 0.0}), leg({0.0, 0.0, 0.0, 0.1})},          // sheared under pressure
      {leg({-0.001, -0.001, -0.001, 0.0}), leg({0.02, -0.01, -0.01, 0.0})},  // under little pressure
      {leg(uniaxial(0.01)), leg(uniaxial(-0.03))},                           // pulled, then compressed
      {leg({0.001, 0.001, 0.001, 0.01})},                                    // sheared under tension
  };
  for (const double beta : {0.0, 0.4, 1.0})
    for (std::size_t k = 0; k < paths.size(); ++k) {
      const Point exact = integrated(glass(beta), paths[k], 100000),
                  coarse = followed(glass(beta), paths[k], 500), fine = followed(glass(beta), paths[k], 4000);
      const double scale = 1.0e9;
      const auto error = [&](const Point& at) {
        return norm(at.stress - exact.stress) / scale + std::abs(at.damage - exact.damage) +
               std::abs(at.bulking - exact.bulking) / scale;
      };
      CAPTURE(beta, k, exact.damage, exact.bulking, exact.stress.zz, fine.damage, fine.bulking,
              fine.stress.zz);
      CHECK(error(coarse) < 0.05);
      CHECK(error(fine) < 0.03);
      CHECK(fine.work == Approx(exact.work).epsilon(5e-3));
      // All work is stored or dissipated.
      CAPTURE(fine.work, fine.stored, fine.dissipated, coarse.work, coarse.stored, coarse.dissipated);
      const double spread = std::abs(fine.stored) + fine.dissipated;
      CHECK(std::abs(fine.work - fine.stored - fine.dissipated) < 4e-3 * spread);
      CHECK(std::abs(coarse.work - coarse.stored - coarse.dissipated) < 3e-2 * spread);
    }
}

TEST_CASE("JH-2: stress is the derivative of the stored energy, at any damage and bulking",
          "[material][johnson_holmquist]") {
  const JohnsonHolmquist law(elastic, glass(), 1.0e-3);
  Random random(3);
  for (int i = 0; i < 500; ++i) {
    JohnsonHolmquist::State s;
    s.elastic_strain = 0.03 * random.direction() + random.uniform(-0.1, 0.03) * identity();
    s.damage = random.chance(0.5) ? 1.0 : random.uniform(0.0, 0.99);
    s.bulking = random.chance(0.5) ? 0.0 : random.uniform(0.0, 2.0e9);
    const SymmetricTensor stress = law.stress(s), direction = random.direction();
    constexpr double h = 1e-6;
    auto ahead = s, behind = s;
    ahead.elastic_strain += h * direction, behind.elastic_strain -= h * direction;
    const double slope = (law.stored_energy(ahead) - law.stored_energy(behind)) / (2.0 * h);
    REQUIRE(slope == Approx(contract(stress, direction)).epsilon(1e-6).margin(2.0e-6 * K1));
  }
}

TEST_CASE("JH-2: random paths create no energy and keep damage and bulking in bounds",
          "[material][johnson_holmquist][energy]") {
  for (const double beta : {0.0, 1.0}) {
    const JohnsonHolmquist law(elastic, glass(beta), 1.0e-3);
    Random random(4);
    for (int path = 0; path < 300; ++path) {
      JohnsonHolmquist::State s;
      double work = 0.0, dissipated = 0.0, most = 0.0;
      for (int k = 0; k < 8; ++k) {
        const SymmetricTensor strain = random.uniform(0.0, 0.05) * random.direction();
        for (int i = 0; i < 200; ++i) {
          const SymmetricTensor before = law.stress(s);
          const double damage = s.damage, bulking = s.bulking;
          PointReport report;
          law.advance(s, (1.0 / 200) * strain, 1e-8, report);
          REQUIRE(report.dissipation.plastic >= -1e-9);
          REQUIRE(report.dissipation.damage >= 0.0);
          REQUIRE((s.damage >= damage && s.damage <= 1.0 && s.bulking >= bulking));
          REQUIRE(law.pressure(s) >= -0.15e9 * (1.0 - s.damage) - 1.0);
          dissipated += report.dissipation.total();
          work += 0.5 / 200 * contract(before + law.stress(s), strain);
          most = std::max(most, std::abs(work));
        }
      }
      // A fracture inside an increment is known to the strength times the increment.
      constexpr double fractures = 0.15e9 * 0.05 / 200;
      REQUIRE(std::abs(work - law.stored_energy(s) - dissipated) < 0.02 * most + fractures);
    }
  }
}

TEST_CASE("JH-2: what an initial stress cannot keep is booked", "[material][jh2][energy]") {
  MaterialParameters parameters;
  parameters.name = "glass", parameters.elastic = elastic;
  const auto material =
      std::make_shared<Batch<JohnsonHolmquist>>(parameters, JohnsonHolmquist(elastic, glass(), 1e-3));
  Random random(31);
  for (const double tension : {0.5, 0.99, 1.01, 1.2, 7.0})
    for (const double shear : {0.0, 0.3}) {
      CAPTURE(tension, shear);
      PointState s = material->start(tension * 0.15e9 * (identity() + shear * deviator(random.direction())));
      const double given = material->stored_energy(s);
      PointReport report;
      material->judge(s, report);
      CHECK(material->stored_energy(s) + report.dissipation.total() == Approx(given).epsilon(1e-9));
      CHECK((report.dissipation.total() > 0.0) == (tension > 1.0));
    }
}

TEST_CASE("JH-2: events stand where they happen, however long the increments", "[material][jh2][events]") {
  const JohnsonHolmquist law(elastic, glass(), 1e-3);
  const auto first = [&](const SymmetricTensor& strain, EventKind kind, int steps) {
    JohnsonHolmquist::State s;
    for (int i = 0; i < steps; ++i) {
      PointReport report;
      law.advance(s, (1.0 / steps) * strain, 1e-6 / steps, report);
      for (const Event& event : report.events)
        if (event.kind == kind) return std::pair((i + event.fraction) / steps, event.stress);
    }
    FAIL("no such event");
    return std::pair(0.0, 0.0);
  };
  // Hydrostatic tension: at T.
  const SymmetricTensor swelling = 0.01 * identity();
  for (const int steps : {1, 7, 100}) {
    const auto [at, stress] = first(swelling, EventKind::damage, steps);
    CHECK(stress == Approx(0.15e9).epsilon(0.03));
    CHECK(at == Approx(0.15e9 / K1 / 0.03).epsilon(0.03));
  }
  // Compression in one direction: yield and damage together, where the strength is met.
  const SymmetricTensor compression{0.0, -0.15, 0.0, 0.0};
  const double exact = first(compression, EventKind::yield, 2000).first;
  for (const int steps : {4, 20, 100})
    for (const EventKind kind : {EventKind::yield, EventKind::damage})
      CHECK(first(compression, kind, steps).first == Approx(exact).epsilon(0.02 + 0.5 / (steps * steps)));
}
