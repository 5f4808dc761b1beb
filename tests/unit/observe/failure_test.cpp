#include <cmath>
#include <numbers>

#include "catch.hpp"
#include "observe/failure.hpp"
#include "observe/fragments.hpp"
#include "support/mpm_run.hpp"

using namespace vitrum;
using namespace vitrum::test;

namespace {

const std::string models =
    "[material.elastic.damage]\ntoughness = 0.83e6\nk = 5.0e26\nm = 6\n"
    "[material.elastic.decohesion]\nopening = 5.0e-6\nmode_ratio = 50.0\n"
    "[material.hard]\ndensity = 2.0\nyoung = 1.0\npoisson = 0.25\n";

/// A brittle plate 20 x 4 under a hard punch 4 x 4 that comes from above, one particle a cell.
MpmScene punch(const char* geometry) {
  MpmScene scene;
  scene.geometry = geometry;
  const double left = std::string(geometry) == "axisymmetric" ? 0.0 : -2.0;
  scene.tables = body("plate", box({5.0 * left, 0.0}, {5.0 * left + 20.0, 4.0})) +
                 "[[body]]\nname = \"punch\"\nmaterial = \"hard\"\n" + box({left, 4.0}, {left + 4.0, 8.0}) +
                 "\nvelocity = [0.0, -1.0]\n" + models;
  return scene;
}

std::vector<double>& variable(MpmRun& run, std::string_view name) {
  return run.particles().variables[*run.system.bodies[0].material->column(name)];
}
void separate(MpmRun& run, std::size_t particle) {
  variable(run, "decohesion")[particle] = 1.0;
  variable(run, "effective_length")[particle] = 1.0;
}
/// Separates the plate's particles with |x - at| < half.
void cut(MpmRun& run, double at, double half) {
  for (std::size_t i = 0; i < run.particles().size; ++i)
    if (std::abs(run.particles().position[0][i] - at) < half) separate(run, i);
}

}  // namespace

TEST_CASE("An intact plate is one piece; bodies that cannot separate are none", "[observe]") {
  MpmRun run(punch("plane-strain"));
  const auto pieces = connected_pieces(run.system);
  REQUIRE(pieces.size() == 1);
  CHECK(pieces[0].body == 0);
  CHECK(pieces[0].particles.size() == 80);
}

TEST_CASE("A crack one particle wide parts the plate; one with a bridge does not", "[observe]") {
  MpmRun run(punch("plane-strain"));
  cut(run, -4.5, 0.1);
  auto pieces = connected_pieces(run.system);
  REQUIRE(pieces.size() == 2);
  CHECK(pieces[0].particles.size() == 56);  // 14 and 5 columns of 4
  CHECK(pieces[1].particles.size() == 20);
  for (std::size_t i = 0; i < run.particles().size; ++i)
    if (run.particles().position[0][i] == -4.5 && run.particles().position[1][i] == 0.5)
      variable(run, "decohesion")[i] = 0.999;
  pieces = connected_pieces(run.system);
  REQUIRE(pieces.size() == 1);
  CHECK(pieces[0].particles.size() == 77);
}

TEST_CASE("Pieces join within a cell and a half and not beyond", "[observe]") {
  for (const auto& [gap, expected] : {std::pair{0.49, std::size_t{1}}, std::pair{0.51, std::size_t{2}}}) {
    MpmRun run(punch("plane-strain"));
    for (double& x : run.particles().position[0])
      if (x > 0.0) x += gap;  // neighbours at -0.5 and 0.5 + gap
    CHECK(connected_pieces(run.system).size() == expected);
  }
}

TEST_CASE("A piece's mass, centre and velocity; axisymmetric masses are of the whole ring", "[observe]") {
  MpmRun run(punch("axisymmetric"));
  cut(run, 9.5, 0.1);
  for (std::size_t i = 0; i < run.particles().size; ++i)
    run.particles().velocity[1][i] = run.particles().position[0][i] > 9.5 ? 7.0 : 0.0;
  const std::vector<Fragment> f = fragments(run.system, connected_pieces(run.system));
  REQUIRE(f.size() == 2);
  CHECK(f[0].mass == Approx(std::numbers::pi * (400.0 - 100.0) * 4.0));
  CHECK(f[1].mass == Approx(std::numbers::pi * 81.0 * 4.0));
  CHECK(f[0].particles == 40);
  CHECK(f[0].velocity[1] == Approx(7.0));
  CHECK(f[0].centre[1] == Approx(2.0));
  CHECK(f[1].centre[0] == Approx(6.0).epsilon(0.01));  // 2 R / 3 in mass
  CHECK(f[0].body == "plate");
}

TEST_CASE("First events are the earliest inside their steps, and the fronts the farthest", "[observe]") {
  MpmRun run(punch("axisymmetric"));
  System& s = run.system;
  FailureAnalysis failure(s);
  CHECK_FALSE(failure.report(s, false).first_localisation);
  s.time = 1.0;
  s.record.events = {{0, 7, {EventKind::localisation, 0.8, 0.0}},
                     {0, 3, {EventKind::localisation, 0.3, 0.0}},
                     {0, 5, {EventKind::yield, 0.1, 0.0}}};
  failure.step(s, 0.5);
  s.time = 1.5;
  s.record.events = {{0, 9, {EventKind::localisation, 0.0, 0.0}}, {0, 9, {EventKind::separation, 0.5, 0.0}}};
  variable(run, "crack_density")[12] = 0.01;
  variable(run, "crack_density")[15] = 0.4;
  separate(run, 12);
  variable(run, "effective_length")[17] = 1.0;
  variable(run, "opening_n")[17] = 3e-6, variable(run, "opening_t")[17] = -4e-6;
  failure.step(s, 0.5);
  const FailureReport r = failure.report(s, false);
  REQUIRE((r.first_localisation && r.first_separation && r.first_damage));
  CHECK(r.first_localisation->time == Approx(0.65));
  CHECK(r.first_localisation->r == 3.5);
  CHECK(r.first_localisation->body == "plate");
  CHECK(r.first_separation->time == Approx(1.25));
  CHECK(r.first_damage->time == 1.5);
  CHECK(r.first_damage->r == 12.5);
  CHECK(r.localised == 2);
  CHECK(r.separated == 1);
  const Particles& p = run.particles();
  const double volume = 2.0 * std::numbers::pi * (p.mass[12] + p.mass[17]);  // density 1
  CHECK(r.localised_volume == Approx(volume).epsilon(1e-14));
  CHECK(r.crack_area == Approx(volume).epsilon(1e-14));  // L_e = 1
  CHECK(*r.localised_radius_max == 17.5);
  CHECK(*r.damage_front_radius == 15.5);  // D passes 0.1 at 0.4, not at 0.01
  CHECK(*r.max_opening == Approx(5e-6));
  CHECK(*r.max_opening_radius == 17.5);
  CHECK_FALSE(r.perforated);  // not asked for
}

TEST_CASE("Perforation: the punch is through and the target's main piece has left its column", "[observe]") {
  MpmRun run(punch("plane-strain"));
  System& s = run.system;
  const FailureAnalysis failure(s);
  const auto perforated = [&] { return failure.report(s, true).perforated; };
  CHECK(perforated() == false);
  // The plug (columns -1.5 .. 1.5) is cut out and driven along; the punch's front must pass the far face by a
  // cell.
  cut(run, -2.5, 0.1), cut(run, 2.5, 0.1);
  CHECK(connected_pieces(s).size() == 3);
  const auto drive = [&](double by) {
    for (double& z : s.bodies[1].particles.position[1]) z -= by;
    for (std::size_t i = 0; i < run.particles().size; ++i)
      if (std::abs(run.particles().position[0][i]) < 2.0) run.particles().position[1][i] -= by;
  };
  drive(4.0);
  CHECK(perforated() == false);
  drive(2.0);
  CHECK(perforated() == true);
}

TEST_CASE(
    "A target that the punch has left behind but whose main piece still fills the column is not perforated",
    "[observe]") {
  MpmRun run(punch("plane-strain"));
  System& s = run.system;
  const FailureAnalysis failure(s);
  for (double& z : s.bodies[1].particles.position[1]) z -= 20.0;
  CHECK(failure.report(s, true).perforated == false);
}

TEST_CASE("A punch that has passed a target of which nothing or only debris is left has perforated it",
          "[observe]") {
  MpmRun run(punch("plane-strain"));
  System& s = run.system;
  const FailureAnalysis failure(s);
  const auto perforated = [&] { return failure.report(s, true).perforated; };
  cut(run, 0.0, 20.0);
  REQUIRE(connected_pieces(s).empty());
  CHECK(perforated() == false);  // rubble, but the punch is still above it
  for (double& z : s.bodies[1].particles.position[1]) z -= 20.0;
  CHECK(perforated() == true);
  // Seven of 80 particles in the column are debris, eight are a piece that bars the way.
  std::size_t whole = 0;
  for (std::size_t i = 0; i < run.particles().size && whole < 8; ++i) {
    if (!(std::abs(run.particles().position[0][i]) < 2.0)) continue;
    variable(run, "decohesion")[i] = 0.5;
    CHECK(perforated() == (++whole < 8));
  }
}

TEST_CASE("A body that leaves the target behind from the start is no projectile, however fast", "[observe]") {
  MpmRun run(punch("plane-strain"));
  for (double& v : run.system.bodies[1].particles.velocity[1]) v = std::abs(v);
  const FailureAnalysis failure(run.system);
  cut(run, 0.0, 20.0);
  for (double& z : run.system.bodies[1].particles.position[1]) z += 20.0;
  CHECK_FALSE(failure.report(run.system, true).perforated.has_value());
}

TEST_CASE("A scene without projectile or target has no answer to perforation", "[observe]") {
  MpmScene scene;
  scene.tables = body("plate", box({0.0, 0.0}, {4.0, 4.0})) + models;
  MpmRun run(scene);
  const FailureAnalysis failure(run.system);
  CHECK_FALSE(failure.report(run.system, true).perforated.has_value());
}
