#include <cmath>

#include "catch.hpp"
#include "support/adaptive_run.hpp"
#include "support/mpm_measure.hpp"

using namespace vitrum;
using namespace vitrum::test;

// Local events (onset of yield, of damage) happen inside global steps and do not end them: the material finds
// them within its increment, the embedded pair sees what is left of the kink.

namespace {

/// The block of `swinging_body`, of a material that yields (or is damaged) in mid-run.
MpmRun with_model(const std::string& model, const std::string& lines, double speed) {
  MpmScene scene;
  scene.shape = "bspline2", scene.method = "arkode-explicit";
  scene.pace = lines + fmt::format("\nvelocity_scale = {:g}\nstrain_scale = {:g}", speed, speed);
  scene.tables = body("block", box({0.0, 0.0}, {8.0, 6.0}), "particles_per_cell = 4") + model;
  MpmRun run(scene);
  Particles& p = run.particles();
  for (std::size_t i = 0; i < p.size; ++i) {
    p.velocity[0][i] = speed * std::sin(0.39 * p.position[0][i]);
    p.velocity[1][i] = 0.7 * speed * std::cos(0.52 * p.position[1][i]);
  }
  run.reopen_ledger();
  return run;
}

double difference(const MpmRun& a, const MpmRun& b, double speed) {
  return velocity_difference(a, b) * swing / speed;
}

constexpr double amplitude = 1e-3;
constexpr const char* yielding =
    "[material.elastic.von_mises]\nyield = 3e-4\npeak = 1.0\nhardening = 0.1\nsoftening = 0.0\n";
constexpr const char* damaging =
    "[material.elastic.damage]\ntoughness = 1.0\nk = 4e22\nm = 6\nrate = {fixed = 1.0}\n";

/// After half a wave; local: a [constitutive] method.
MpmRun finished(const std::string& model, const std::string& local, const std::string& lines) {
  MpmRun run = with_model(model + fmt::format("[constitutive]\nmethod = \"{}\"\nrtol = 1e-9\n", local), lines,
                          amplitude);
  run.advance(4.0);
  return run;
}

double order_with_events(const std::string& model, const std::string& local) {
  const auto with_step = [&](double step) {
    return finished(model, local, fmt::format("order = 3\nrtol = 1e-6\nfixed_step = {:.17g}", step));
  };
  const MpmRun exact = with_step(0.0025);
  REQUIRE(exact.system.constitutive_events > 20);
  const double coarse = difference(with_step(0.1), exact, amplitude),
               fine = difference(with_step(0.025), exact, amplitude);
  CAPTURE(coarse, fine);
  return order(coarse, fine, 4.0);
}

}  // namespace

TEST_CASE("Events inside fixed steps: second order with local error control, and for damage",
          "[verification][events]") {
  const double substepped = order_with_events(yielding, "substep"),
               damaged = order_with_events(damaging, "closed-form");
  CAPTURE(substepped, damaged);
  CHECK(substepped > 1.7);
  CHECK(damaged > 1.7);
  // A return mapping takes turning plastic paths in the direction of their end: first order, in every stage
  // of every table alike, so that no estimate shows it.
  const double returned = order_with_events(yielding, "closed-form");
  CAPTURE(returned);
  CHECK(returned > 0.8);
  CHECK(returned < 1.3);
}

TEST_CASE("Events inside adaptive steps: with local error control the error follows the tolerance",
          "[verification][events]") {
  for (const char* model : {yielding, damaging}) {
    const auto finish = [&](double rtol) {
      return finished(model, "substep", fmt::format("order = 3\nrtol = {:g}", rtol));
    };
    const MpmRun tight = finish(1e-8);
    REQUIRE(tight.system.constitutive_events > 20);
    double last = 1.0;
    for (const double rtol : {1e-2, 1e-4, 1e-6}) {
      const MpmRun run = finish(rtol);
      const double error = difference(run, tight, amplitude);
      const IntegratorCounters& c = run.integrator.state().counters;
      CAPTURE(model, rtol, error, c.steps, c.rejected, run.system.constitutive_events,
              run.integrator.state().error.velocity);
      CHECK(error < 100.0 * rtol);
      CHECK(error < last);
      last = error;
    }
  }
}
