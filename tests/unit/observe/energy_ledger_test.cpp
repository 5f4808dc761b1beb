#include <cmath>
#include <limits>

#include "catch.hpp"
#include "observe/energy_ledger.hpp"
#include "support/mpm_run.hpp"
#include "support/random_states.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

MpmScene stressed(const char* geometry, const std::string& more) {
  MpmScene scene;
  scene.geometry = geometry;
  scene.tables = body("block", box({0.0, 0.0}, {4.0, 2.0}), more);
  return scene;
}

}  // namespace

TEST_CASE("The ledger opens with the kinetic and elastic energy of the scene", "[observe]") {
  MpmRun run(stressed("plane-strain", "velocity = [3.0, 4.0]\nstress = [1e-3, 0.0, 0.0, 2e-3]"));
  // s:s/2E form: (1 + nu)/E s:s - nu/E tr^2, halved; the reference volume is 8.
  const double nu = unit_poisson, E = unit_young, squared = 1e-6 + 2.0 * 4e-6;
  const double elastic = 0.5 * 8.0 * ((1.0 + nu) * squared - nu * 1e-6) / E;
  CHECK(run.energy().kinetic == Approx(0.5 * 8.0 * 25.0).epsilon(1e-13));
  CHECK(run.energy().elastic == Approx(elastic).epsilon(1e-12));
  CHECK(run.energy().initial == run.energy().kinetic + run.energy().elastic);
  CHECK(run.ledger.growth() == Approx(1.0));
  CHECK(run.energy().residual() == 0.0);
}

TEST_CASE("Axisymmetric energies are per radian", "[observe]") {
  MpmRun run(stressed("axisymmetric", "velocity = [0.0, 1.0]"));
  CHECK(run.energy().kinetic == Approx(0.5 * 0.5 * 16.0 * 2.0));  // r^2/2 x height per radian
  const EnergyTotals whole = scaled(run.energy(), 2.0);
  CHECK(whole.kinetic == 2.0 * run.energy().kinetic);
  CHECK(whole.initial == 2.0 * run.energy().initial);
  CHECK(whole.max_growth == run.energy().max_growth);
}

TEST_CASE("The ledger books what a step's record says", "[observe]") {
  MpmRun run(stressed("plane-strain", "velocity = [1.0, 0.0]"));
  System& s = run.system;
  EnergyLedger ledger(s);
  const double initial = ledger.totals().initial;
  s.record.kinetic = 0.5 * initial, s.record.elastic = 0.7 * initial;
  s.record.dissipated = {1.0, 2.0, 3.0, 0.5};
  s.record.external_work = 4.0;
  ledger.step(s, 0.0);
  ledger.step(s, 0.0);
  const EnergyTotals& t = ledger.totals();
  CHECK(t.plastic == 2.0);
  CHECK(t.damage == 4.0);
  CHECK(t.fracture == 6.0);
  CHECK(t.snap_back == 1.0);
  CHECK(t.external == 8.0);
  CHECK(t.max_growth == Approx(1.2));
  CHECK(ledger.growth() == Approx(1.2 * initial / (initial + 8.0)));
  CHECK(t.residual() == Approx(initial + 8.0 - 1.2 * initial - 12.0));
  CHECK(t.relative_residual() == Approx(t.residual() / std::max(initial, 8.0)));
  // Snap-back is part of fracture: not subtracted twice. Work taken out does not excuse growth.
  s.record.external_work = -100.0;
  ledger.step(s, 0.0);
  CHECK(ledger.growth() == Approx(1.2));
}

TEST_CASE("A scene at rest has growth 1, and nothing hides a value that is not finite", "[observe]") {
  MpmRun run(stressed("plane-strain", ""));
  System& s = run.system;
  EnergyLedger ledger(s);
  CHECK(ledger.growth() == 1.0);
  CHECK(ledger.totals().relative_residual() == 0.0);
  s.record.kinetic = std::numeric_limits<double>::quiet_NaN();
  ledger.step(s, 0.0);
  CHECK_FALSE(ledger.growth() <= 1.5);
  System nothing;
  EnergyLedger other(nothing, EnergyTotals{});
  s.record.kinetic = std::numeric_limits<double>::infinity();
  other.step(s, 0.0);
  CHECK_FALSE(other.growth() <= 1.5);
}

TEST_CASE("Work that is taken back stays the scale of the residual", "[observe]") {
  MpmRun run(stressed("plane-strain", ""));
  System& s = run.system;
  EnergyLedger ledger(s);
  for (const double work : {8.0, -7.0, -1.0 + 1e-9}) {  // a wall that comes and goes
    s.record.kinetic = 0.0, s.record.elastic = 0.0;
    s.record.dissipated = {};
    s.record.external_work = work;
    ledger.step(s, 0.0);
  }
  s.record.kinetic = 0.01;
  s.record.external_work = 0.0;
  ledger.step(s, 0.0);
  CHECK(ledger.totals().relative_residual() == Approx(-0.01 / 8.0));
  CHECK(judge(ledger.totals(), 0.0) == EnergyAccount::closes);
}

TEST_CASE("What an energy account says of its run does not depend on the unit of energy", "[observe]") {
  Random random(3);
  int counts[3] = {};
  for (int i = 0; i < 2000; ++i) {
    EnergyTotals t;
    t.initial = random.chance(0.2) ? 0.0 : random.logarithmic(1e-3, 1.0);
    t.external = random.uniform(-0.3, 0.5), t.largest_work = std::max(std::abs(t.external), 0.1);
    t.kinetic = random.uniform(0.0, 1.0);
    const double error = (random.chance(0.5) ? 1.0 : -1.0) * t.scale() * random.logarithmic(1e-4, 10.0);
    t.elastic = t.initial + t.external - t.kinetic - error;
    if (random.chance(0.5)) t.plastic = t.elastic, t.elastic = -1e-13 * t.scale();  // negative by rounding
    const EnergyAccount found = judge(t, 0.0);
    ++counts[static_cast<int>(found)];
    REQUIRE(judge(scaled(t, 1e-40), 0.0) == found);
    REQUIRE(judge(scaled(t, 1e40), 0.0) == found);
    // Less than a tolerance, nothing is wrong.
    CHECK(judge(t, 20.0) == EnergyAccount::closes);
  }
  for (const int count : counts) CHECK(count > 100);
  EnergyTotals broken;
  broken.initial = 1.0, broken.kinetic = std::numeric_limits<double>::quiet_NaN();
  CHECK(judge(broken, 0.0) == EnergyAccount::meaningless);
}
