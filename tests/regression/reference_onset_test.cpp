#include "catch.hpp"
#include "integrators/grid/explicit.hpp"
#include "observe/failure.hpp"
#include "scene/build_system.hpp"
#include "scene/read_scene.hpp"
#include "vitrum_source_dir.hpp"

using namespace vitrum;

namespace {

struct Watch final : StepObserver {
  FailureAnalysis& failure;
  explicit Watch(FailureAnalysis& f) : failure(f) {}
  bool step_done(System& system, double step) override {
    failure.step(system, step);
    return true;
  }
};

}  // namespace

// The onset of failure is the part of the reference case that does not depend on rounding: later fragments
// do. The figures are this program's own (MUSL, 0.05 us); a change of a law or a scheme that moves them must
// say why.
TEST_CASE("The reference case fails first where it did", "[regression]") {
  const Scene scene = read_scene(VITRUM_SOURCE_DIR "/studies/paper/reference.toml",
                                 {"integrator.scheme=\"musl\"", "integrator.step=5e-8"});
  System system = build_system(scene, 1);
  FailureAnalysis failure(system);
  Watch watch(failure);
  ExplicitIntegrator integrator(StepScheme::musl, scene.integrator.step, {});
  integrator.advance(system, 0.0, watch);
  const FailureReport report = failure.report(system, false);
  REQUIRE(report.bodies.size() == 2);
  const FailureMeasures &plate = report.bodies[0], &cylinder = report.bodies[1];
  REQUIRE(plate.first_localisation);
  REQUIRE(cylinder.first_localisation);
  CAPTURE(plate.first_localisation->time, plate.first_localisation->r, plate.first_localisation->z);
  CHECK(cylinder.first_localisation->time == Approx(-2.2278e-6).margin(0.002e-6));
  CHECK(cylinder.first_localisation->r == Approx(3.5e-3).margin(0.05e-3));
  CHECK(plate.first_localisation->time == Approx(-1.5119e-6).margin(0.002e-6));
  CHECK(plate.first_localisation->r == Approx(2.5e-3).margin(0.05e-3));
  CHECK(report.first_localisation->body == "cylinder");
}
