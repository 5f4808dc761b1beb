#include "catch.hpp"
#include "support/literal_damage.hpp"
#include "support/material_samples.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

struct Onset {
  double x, damage, strain, stress;  // at rate 1/s
  SymmetricTensor direction;
  double mean_rate_factor;  // mean strain per unit of `strain`
};
const Onset uniaxial{0.118315, 0.201315, 1.471237e-4, 10.808642e6, {1.0, 0.0, 0.0, 0.0}, 1.0 / 3.0};
const Onset hydrostatic{0.165842, 0.272129, 5.188045e-5, 5.437771e6, {1.0, 1.0, 1.0, 0.0}, 1.0};

struct Localised {
  CompositeState state;
  double strain;
};
/// Stretches to three times the onset strain in one increment, with an opening so large that the plane stays
/// closed at first.
Localised stretch_to_localisation(const Onset& onset, double rate, bool all_planes) {
  const auto glass = composite_of(fracturing_glass(all_planes), cell);
  const double end = 3.0 * onset.strain * std::cbrt(rate);
  const double duration = end * onset.mean_rate_factor / rate;
  PointReport report;
  CompositeState probe;
  glass->respond(probe, end * onset.direction, duration, report);
  double fraction = -1.0;
  for (std::size_t i = 0; i < report.events.size(); ++i)
    if (report.events[i].kind == EventKind::localisation) fraction = report.events[i].fraction;
  REQUIRE(fraction > 0.0);
  Localised result{{}, fraction * end};
  PointReport again;
  glass->respond(result.state, fraction * (1.0 - 1e-13) * end * onset.direction, fraction * duration, again);
  return result;
}

}  // namespace

TEST_CASE("onset of localisation in uniaxial and hydrostatic strain", "[material][damage][bifurcation]") {
  for (const bool all : {false, true})
    for (const Onset& onset : {uniaxial, hydrostatic})
      for (const double rate : {1.0, 1.0e3, 1.0e5}) {
        CAPTURE(all, onset.x, rate);
        const Localised found = stretch_to_localisation(onset, rate, all);
        const double scale = std::cbrt(rate);
        CHECK(found.strain == Approx(onset.strain * scale).epsilon(1e-6));
        CHECK(found.state.crack_density / crack_density_limit == Approx(onset.x).margin(1e-6));
        CHECK(found.state.stress.rr == Approx(onset.stress * scale).epsilon(1e-6));
        CHECK(literal_glass().moduli(found.state.crack_density).damage == Approx(onset.damage).margin(2e-6));
      }
}

TEST_CASE("strengths at 1000 /s", "[material][damage][bifurcation]") {
  CHECK(stretch_to_localisation(uniaxial, 1.0e3, false).state.stress.rr == Approx(108.09e6).epsilon(1e-4));
  CHECK(stretch_to_localisation(hydrostatic, 1.0e3, false).state.stress.rr == Approx(54.38e6).epsilon(1e-4));
}

TEST_CASE("damage at the onset falls with the volume change of the strain",
          "[material][damage][bifurcation]") {
  // What docs/reports/study-paper.md says of damage that leads separation.
  struct Case {
    SymmetricTensor strain;
    double damage;
  };
  for (const Case& c : {Case{{1.0, 0.0, 0.0, 0.0}, 0.201}, Case{{1.0, -0.4, -0.4, 0.0}, 0.088},
                        Case{{1.0, -0.49, -0.49, 0.0}, 0.013}})
    for (const double rate : {1.0, 1e4}) {
      const auto glass = composite_of(fracturing_glass(), cell);
      const double size = 0.1;
      const Driven d = drive(*glass, {{size * c.strain, size * trace(c.strain) / (3.0 * rate)}}, 1);
      CAPTURE(c.damage, rate);
      REQUIRE(is_localised(d.state));
      CHECK(glass->damage(d.state) == Approx(c.damage).margin(6e-4));
    }
}
