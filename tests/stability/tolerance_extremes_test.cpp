#include <cmath>

#include "app/watchdog.hpp"
#include "catch.hpp"
#include "mpm/computation_error.hpp"
#include "support/reference_case.hpp"

using namespace vitrum;
using namespace vitrum::test;

// Tolerances and steps at their ends, in the complete reference case with a small plate: sound, or stopped
// with a cause. A wrong result never comes out as a completed run.

namespace {

enum class Ending { sound, watchdog, error };

/// Runs to `end` under the watchdog (bound 1.5). Where it ends, all that would be written is finite.
Ending ending(const std::vector<std::string>& changes, double end, std::int64_t most_steps = 100000) {
  MpmRun run(reference(changes + plate_radius(0.02)));
  const app::Watchdog watchdog(1.5, run.integrator);
  bool stopped = false;
  run.watch = [&](double step) {
    stopped = watchdog.look(run.system, run.ledger, step).has_value();
    return !stopped && run.system.step_index < most_steps;
  };
  Ending result = Ending::sound;
  try {
    run.advance(end);
  } catch (const ComputationError& error) {
    result = Ending::error;
    CHECK(std::string(error.what()).find("body '") != std::string::npos);
  }
  if (stopped) return Ending::watchdog;
  const EnergyTotals& e = run.energy();
  CAPTURE(changes, e.max_growth, e.relative_residual(), run.system.time, run.system.step_index);
  CHECK(e.max_growth <= 1.02);
  CHECK(std::abs(e.relative_residual()) < 0.05);
  CHECK(std::isfinite(e.plastic + e.damage + e.fracture + largest_speed(run.system)));
  if (result == Ending::sound && run.system.step_index < most_steps) CHECK(run.system.time == end);
  return result;
}

std::vector<std::string> adaptive(const std::string& method, double rtol) {
  return {fmt::format("integrator.method=\"{}\"", method), fmt::format("integrator.rtol={}", rtol)};
}

}  // namespace

TEST_CASE("Tolerances of the momentum equations from 0.99 to 1e-13", "[stability][extreme]") {
  for (const char* method : {"arkode-explicit", "arkode-implicit"}) {
    for (const double rtol : {0.99, 0.5, 0.1, 1e-2, 1e-4, 1e-6})
      CHECK(ending(adaptive(method, rtol), 1e-6) == Ending::sound);
    // Tighter than steps can follow: as far as 1,000 steps lead, or a collapse that names its cause.
    for (const double rtol : {1e-10, 1e-13})
      CHECK(ending(adaptive(method, rtol), 1e-6, 1000) != Ending::watchdog);
  }
}

TEST_CASE("Tolerances of the local equations from 0.5 to 1e-13", "[stability][extreme]") {
  const std::vector<std::string> grid{"integrator.scheme=\"musl\"", "integrator.courant=0.2"};
  for (const char* method : {"substep", "cvode"})
    for (const double rtol : {0.5, 3e-2, 1e-3, 1e-6, 1e-10, 1e-13})
      CHECK(ending(grid + std::vector<std::string>{fmt::format("constitutive.method=\"{}\"", method),
                                                   fmt::format("constitutive.rtol={}", rtol)},
                   1e-6) != Ending::watchdog);
}

TEST_CASE("Explicit steps from a millionth to ten times the critical one", "[stability][extreme]") {
  const double critical = 1e-3 / 5879.0 / std::sqrt(2.0);  // s: glass, any particle positions
  for (const char* scheme : {"usf", "musl"}) {
    const auto with = [&](double multiple) {
      return std::vector<std::string>{fmt::format("integrator.scheme=\"{}\"", scheme),
                                      fmt::format("integrator.step={}", multiple * critical)};
    };
    CAPTURE(scheme);
    for (const double multiple : {0.01, 0.1, 0.3}) CHECK(ending(with(multiple), 5e-6) == Ending::sound);
    for (const double multiple : {1e-6, 1e-4}) CHECK(ending(with(multiple), 5e-6, 2000) == Ending::sound);
    for (const double multiple : {2.5, 4.0, 10.0}) CHECK(ending(with(multiple), 20e-6) != Ending::sound);
  }
}

TEST_CASE("A step so short that thousands of them leave the time as it is", "[stability][extreme]") {
  MpmScene scene;
  scene.pace = "courant = 1e-17";
  scene.tables = body("block", box({0.0, 0.0}, {3.0, 3.0}));
  MpmRun run(scene);
  run.system.time = 1.0;
  try {
    run.advance(2.0);
    FAIL("no error");
  } catch (const ComputationError& error) {
    CHECK(std::string(error.what()).find("below the rounding of the time") != std::string::npos);
  }
}
