#include <cmath>

#include "catch.hpp"
#include "materials/batch.hpp"
#include "materials/maxwell.hpp"
#include "support/random_states.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

const ElasticParameters elastic{1100.0, 1.31e9, 0.39};
const Moduli moduli = elastic_moduli(elastic);

MaxwellParameters three_branches() {
  MaxwellParameters p;
  p.ratios = {0.5, 0.3, 0.15}, p.times = {2.0e-7, 1.0e-4, 3.0};
  p.C1 = 20.7, p.C2 = 91.1, p.reference_temperature = 293.15, p.temperature = 293.15;
  return p;
}

struct Followed {
  Maxwell::State state;
  double dissipated = 0.0;
};
Followed follow(const Maxwell& law, const SymmetricTensor& strain, double duration, int steps,
                Maxwell::State s = {}) {
  Followed f{s};
  for (int i = 0; i < steps; ++i) {
    PointReport report;
    law.advance(f.state, (1.0 / steps) * strain, duration / steps, report);
    REQUIRE(report.dissipation.total() >= 0.0);
    f.dissipated += report.dissipation.total();
  }
  return f;
}

}  // namespace

TEST_CASE("Maxwell at constant rate is the closed form, whatever the step", "[material][maxwell]") {
  const Maxwell law(elastic, three_branches(), 1.0e-3);
  Random random(1);
  for (const double duration : {1.0e-9, 1.0e-7, 1.0e-5, 1.0e-2, 10.0}) {
    const SymmetricTensor strain = 0.01 * random.direction(), d = deviator(strain);
    // sigma = 3 K mean + 2 G(oo) d + sum 2 G_i (tau_i/t) (1 - exp(-t/tau_i)) d; each dashpot dissipates its
    // work less what its spring stores.
    double shear = moduli.shear * 0.05, dissipated = 0.0, stored = 0.0;
    for (const auto& [ratio, time] : {std::pair{0.5, 2.0e-7}, {0.3, 1.0e-4}, {0.15, 3.0}}) {
      const long double y = duration / time, relaxed = -std::expm1(-y), branch = ratio * moduli.shear;
      shear += static_cast<double>(branch * relaxed / y);
      const long double work = 2.0L * branch * (y - relaxed) / (y * y),
                        held = branch * relaxed * relaxed / (y * y);
      dissipated += static_cast<double>(work - held) * contract(d, d);
      stored += static_cast<double>(held) * contract(d, d);
    }
    const SymmetricTensor expected = Moduli{moduli.bulk, shear}.stress(strain);
    stored += Moduli{moduli.bulk, 0.05 * moduli.shear}.energy(strain);
    for (const int steps : {1, 3, 1000}) {
      const Followed f = follow(law, strain, duration, steps);
      CAPTURE(duration, steps);
      CHECK(norm(law.stress(f.state) - expected) < 1e-12 * norm(expected));
      CHECK(f.dissipated == Approx(dissipated).epsilon(duration < 1e-8 ? 1e-6 : 1e-9));
      CHECK(law.stored_energy(f.state) == Approx(stored).epsilon(1e-11));
    }
  }
}

TEST_CASE("Maxwell relaxes as its Prony series after a jump, faster when warm", "[material][maxwell]") {
  MaxwellParameters p = three_branches();
  const SymmetricTensor strain{0.0, 0.0, 0.0, 0.01};
  for (const double warmer : {-10.0, 0.0, 25.0}) {
    p.temperature = 293.15 + warmer;
    const double shift = std::pow(10.0, -20.7 * warmer / (91.1 + warmer));
    const Maxwell law(elastic, p, 1.0e-3);
    Maxwell::State s = follow(law, strain, 0.0, 1).state;
    CHECK(law.stress(s).rz == Approx(2.0 * moduli.shear * 0.01).epsilon(1e-12));
    double time = 0.0;
    for (const double wait : {1.0e-8, 1.0e-6, 1.0e-3, 0.5, 20.0}) {
      const double before = law.stored_energy(s);
      const Followed f = follow(law, {}, wait, 5, s);
      s = f.state, time += wait;
      double remains = 0.05;
      for (const auto& [ratio, tau] : {std::pair{0.5, 2.0e-7}, {0.3, 1.0e-4}, {0.15, 3.0}})
        remains += ratio * std::exp(-time / (shift * tau));
      CHECK(law.stress(s).rz == Approx(2.0 * moduli.shear * 0.01 * remains).epsilon(1e-12));
      CHECK(before - law.stored_energy(s) == Approx(f.dissipated).epsilon(1e-9).margin(1e-9 * before));
    }
  }
}

TEST_CASE("Maxwell: work is stored or dissipated on any path, to the order of the work's rule",
          "[material][maxwell][energy]") {
  const Maxwell law(elastic, three_branches(), 1.0e-3);
  Random random(2);
  Maxwell::State s;
  double work = 0.0, dissipated = 0.0;
  for (int i = 0; i < 200; ++i) {
    const SymmetricTensor strain = 0.01 * random.direction();
    const double duration = std::pow(10.0, random.uniform(-8.0, 0.0));
    // A leg in parts that resolve its fastest branch that still acts.
    for (int k = 0; k < 400; ++k) {
      const SymmetricTensor before = law.stress(s);
      PointReport report;
      law.advance(s, (1.0 / 400) * strain, duration / 400, report);
      REQUIRE(report.dissipation.plastic >= 0.0);
      dissipated += report.dissipation.plastic;
      work += 0.5 / 400 * contract(before + law.stress(s), strain);
    }
  }
  CHECK(work == Approx(law.stored_energy(s) + dissipated).epsilon(2e-3));
}
