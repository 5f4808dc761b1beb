#include "catch.hpp"
#include "support/material_samples.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

TEST_CASE("damage begins where the mean strain turns positive", "[material][damage][events]") {
  const auto glass = composite_of(damaging_glass(), cell);
  for (const int steps : {1, 3, 1000}) {
    const Driven d = drive(*glass, {{-1e-4 * identity(), 1.0}, {4e-4 * identity(), 1e-6}}, steps);
    CAPTURE(steps);
    CHECK(d.count(EventKind::damage) == 1);
    // The crack density of eq. 7 leaves zero with the sixth power of strain: it is announced with the
    // increment that sees it.
    CHECK(d.time_of(EventKind::damage) == Approx(1.0 + 0.25e-6).margin(1.1e-6 / steps));
  }
}

TEST_CASE("the life of a glass point in one increment, in order", "[material][events]") {
  const auto glass = composite_of(fracturing_glass(), cell);
  CompositeState s;
  PointReport report;
  glass->respond(s, {0.02, 0.0, 0.0, 0.0}, 1e-5, report);
  REQUIRE(report.events.size() == 3);
  CHECK(report.events[0].kind == EventKind::damage);
  CHECK(report.events[1].kind == EventKind::localisation);
  CHECK(report.events[2].kind == EventKind::separation);
  // Oracles: eps_1 = 1.471237e-4 R^(1/3), then u0/L_e - tau_np/M more.
  const double scale = std::cbrt(0.02 / 3.0 / 1e-5);
  CHECK(report.events[1].fraction == Approx(1.471237e-4 * scale / 0.02).epsilon(1e-6));
  CHECK(report.events[1].stress == Approx(10.808642e6 * scale).epsilon(1e-6));
  CompositeState stretched =
      s;  // (fully open, the point has no strain: whether cracks are closed is rounding)
  stretched.elastic_strain = 1e-6 * identity();
  const Moduli damaged = glass->secant_moduli(stretched);
  const double softening = 5.0e-6 / cell - 10.808642e6 * scale / damaged.p_wave();
  CHECK(report.events[2].fraction - report.events[1].fraction == Approx(softening / 0.02).epsilon(1e-5));
}

TEST_CASE("a report keeps all events, in order of time whatever rounding says", "[material][events]") {
  PointReport report;
  for (std::size_t i = 0; i < 40; ++i) report.record(EventKind::yield, 0.01 * static_cast<double>(i), {});
  report.record(EventKind::peak, 0.39 - 1e-16, {});
  REQUIRE(report.events.size() == 41);
  CHECK(report.events[20].fraction == 0.2);
  CHECK(report.events.back().fraction == report.events[39].fraction);
  report.clear();
  CHECK(report.events.empty());
}

TEST_CASE("energies of two reports add up", "[material][events]") {
  Dissipation a{1.0, 2.0, 3.0, 0.5};
  a += Dissipation{10.0, 20.0, 30.0, 5.0};
  CHECK(a.plastic == 11.0);
  CHECK(a.damage == 22.0);
  CHECK(a.fracture == 33.0);
  CHECK(a.snap_back == 5.5);
  CHECK(a.total() == 66.0);  // the snap-back is part of fracture
}
