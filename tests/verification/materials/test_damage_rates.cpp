// What eps_v of eq. 7 and its rate may be: closed forms on paths at constant rate, and every local method
// against the others.
#include "catch.hpp"
#include "support/literal_damage.hpp"
#include "support/local_solvers.hpp"
#include "support/material_samples.hpp"
#include "support/random_states.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

constexpr SymmetricTensor uniaxial{1.0, 0.0, 0.0, 0.0};
/// A piece of uniaxial strain at a rate of its trace, 1/s.
Segment stretch(double strain, double rate) {
  return {strain * uniaxial, std::abs(strain) / rate};
}
double density(double eps_v, double rate) {
  return literal_glass().coefficient(rate) * std::pow(eps_v, 6.0);
}

MaterialParameters glass_with(const std::function<void(DamageParameters&)>& choose) {
  MaterialParameters p = damaging_glass();
  choose(*p.damage);
  return p;
}

/// Calls `check` with the end of the path under the closed form and under every solver.
void with_every_method(const MaterialParameters& p, const std::vector<Segment>& path, int steps,
                       const std::function<void(const Driven&)>& check) {
  const auto material = composite_of(p, cell);
  check(drive(*material, path, steps));
  for (LocalSolver& solver : solvers(1e-9)) {
    CAPTURE(solver.name);
    const Driven d = drive(*material, path, steps, {}, solver.integrator.get());
    REQUIRE(d.cause.empty());
    check(d);
  }
}

}  // namespace

TEST_CASE("eps_v may be the volumetric strain, and its rate with it", "[material][damage][rate]") {
  const MaterialParameters p = glass_with([](DamageParameters& d) { d.volumetric = true; });
  with_every_method(p, {stretch(0.4e-3, 1.0e3)}, 3, [](const Driven& d) {
    CHECK(d.state.max_rate == Approx(1.0e3).epsilon(1e-12));
    CHECK(d.state.crack_density == Approx(density(0.4e-3, 1.0e3)).epsilon(1e-7));
  });
}

TEST_CASE("the current rate: a fall of the rate damages at constant strain, and is booked",
          "[material][damage][rate][energy]") {
  const MaterialParameters p = glass_with([](DamageParameters& d) { d.history = DamageRate::current; });
  const std::vector<Segment> path{stretch(1.0e-3, 3.0e4), stretch(0.1e-3, 3.0e3), stretch(-0.5e-3, 1.0e3),
                                  stretch(0.1e-3, 6.0e3)};
  with_every_method(p, path, 40, [&](const Driven& d) {
    CHECK(d.state.max_rate == Approx(2.0e3).epsilon(1e-12));
    // Unloading and the slower reloading up to less strain leave what the second piece made.
    CHECK(d.state.crack_density == Approx(density(1.1e-3 / 3.0, 1.0e3)).epsilon(1e-7));
    CHECK(d.dissipation.damage > 0.0);
    CHECK(d.work ==
          Approx(composite_of(p, cell)->stored_energy(d.state) + d.dissipation.total()).epsilon(3e-3));
  });
}

TEST_CASE("a fall of the current rate may localise at once", "[material][damage][rate][decohesion]") {
  MaterialParameters p = fracturing_glass();
  p.damage->history = DamageRate::current;
  // At 1e4 /s glass localises at 3.17e-3, at 1 /s at 1.47e-4 (uniaxial strain).
  const std::vector<Segment> path{stretch(1.0e-3, 3.0e4), stretch(1.0e-6, 3.0)};
  with_every_method(p, path, 5, [&](const Driven& d) {
    CHECK(is_localised(d.state));
    CHECK(d.time_of(EventKind::localisation) == Approx(path[0].duration).epsilon(1e-9));
    CHECK(d.state.crack_density == Approx(0.118315 * crack_density_limit).epsilon(1e-4));
  });
}

TEST_CASE("the maximum of any sign remembers compression", "[material][damage][rate]") {
  const MaterialParameters p =
      glass_with([](DamageParameters& d) { d.history = DamageRate::maximum_any_sign; });
  with_every_method(p, {stretch(-1.0e-3, 3.0e5), stretch(4.0e-3, 3.0e3)}, 4, [](const Driven& d) {
    CHECK(d.state.max_rate == Approx(1.0e5).epsilon(1e-12));
    CHECK(d.state.crack_density == Approx(density(1.0e-3, 1.0e5)).epsilon(1e-7));
  });
}

TEST_CASE("the averaged rate: R' = (eps_v' - R)/T, exact at constant rate in any steps",
          "[material][damage][rate]") {
  constexpr double time = 1.0e-7, rate = 1.0e3;
  const MaterialParameters p = glass_with([](DamageParameters& d) { d.averaging_time = time; });
  const double strain = 1.5e-3, duration = strain / (3.0 * rate);
  for (const int steps : {1, 7})
    with_every_method(p, {stretch(strain, 3.0 * rate)}, steps, [&](const Driven& d) {
      const double average = rate * (1.0 - std::exp(-duration / time));
      CHECK(d.state.mean_rate == Approx(average).epsilon(1e-12));
      CHECK(d.state.max_rate == Approx(average).epsilon(1e-12));
      CHECK(d.state.crack_density == Approx(density(strain / 3.0, average)).epsilon(1e-7));
    });

  SECTION("the largest so far is kept while the average falls") {
    const Segment back = stretch(-1.0e-3, 3.0e3);
    with_every_method(p, {stretch(strain, 3.0 * rate), back}, 5, [&](const Driven& d) {
      CHECK(d.state.max_rate == Approx(rate * (1.0 - std::exp(-duration / time))).epsilon(1e-12));
      CHECK(d.state.mean_rate < 0.5 * d.state.max_rate);
    });
  }
  SECTION("it has a limit where a front becomes steeper, which the running maximum has not") {
    for (const double steeper : {1.0, 1e2, 1e4}) {
      const std::vector<Segment> front{stretch(1.0e-4, 1.0e7 * steeper)};
      const Driven averaged = drive(*composite_of(p, cell), front, 3);
      CHECK(averaged.state.max_rate == Approx(1.0e-4 / 3.0 / time).epsilon(6e-5 / steeper + 1e-9));
      CHECK(drive(*composite_of(damaging_glass(), cell), front, 3).state.max_rate ==
            Approx(1.0e7 / 3.0 * steeper).epsilon(1e-9));
    }
  }
}

TEST_CASE("what no key names is not stored", "[material][damage][rate]") {
  MaterialParameters p = damaging_glass();
  const std::size_t plain = make_material(p, cell)->columns().size();
  for (const DamageRate rate : {DamageRate::current, DamageRate::maximum_any_sign}) {
    p.damage->history = rate;
    CHECK(make_material(p, cell)->columns().size() == plain);
  }
  p.damage->averaging_time = 1e-6;
  CHECK(make_material(p, cell)->columns().size() == plain + 1);
}

TEST_CASE("solvers and closed form agree whatever the rate", "[material][damage][rate][local]") {
  for (const NamedMaterial& rated : rated_damages()) {
    for (const int models : {0, 1, 2}) {
      MaterialParameters p = rated.parameters;
      if (models > 0) p.decohesion = glass_decohesion();
      if (models > 1) p.drucker_prager = glass_drucker_prager();
      const auto material = composite_of(p, cell);
      const double scale = 1e-3 * elastic_moduli(p.elastic).p_wave();
      Random random(7);
      for (int i = 0; i < 6; ++i) {
        const auto path = path_with_reversals(random, 1.5e-3, random.logarithmic(1e2, 1e4), 4);
        auto all = solvers(1e-8);
        const Driven substep = drive(*material, path, 5, {}, all[0].integrator.get()),
                     bdf = drive(*material, path, 5, {}, all[1].integrator.get());
        CAPTURE(rated.name, models, i);
        REQUIRE(substep.cause.empty());
        REQUIRE(bdf.cause.empty());
        REQUIRE(distance(substep.state.stress, bdf.state.stress) < 1e-5 * scale);
        REQUIRE(substep.state.max_rate == bdf.state.max_rate);
        if (models == 0) {
          const Driven closed = drive(*material, path, 5);
          REQUIRE(distance(substep.state.stress, closed.state.stress) < 1e-5 * scale);
          REQUIRE(closed.state.max_rate == substep.state.max_rate);
          REQUIRE(closed.state.mean_rate == substep.state.mean_rate);
        }
      }
    }
  }
}
