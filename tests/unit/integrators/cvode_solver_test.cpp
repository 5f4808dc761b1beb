#include "integrators/sundials/cvode_solver.hpp"

#include <algorithm>

#include "catch.hpp"

using vitrum::sundials::Context;
using vitrum::sundials::CvodeMethod;
using vitrum::sundials::CvodeSolver;
using vitrum::sundials::OdeSystem;

namespace {

/// y' = 1, with one root function: y - level, or nothing but 0.
class Ramp final : public OdeSystem {
 public:
  double level = 0.5;
  bool always_zero = false;

  bool rates(double, const double*, double* out) override { return out[0] = 1.0, true; }
  bool has_jacobian() const override { return false; }
  void jacobian(double, const double*, double*) override {}
  void roots(double, const double* y, double* values) override {
    std::fill(values, values + CvodeSolver::roots, -1.0);
    values[0] = always_zero ? 0.0 : y[0] - level;
  }
};

}  // namespace

TEST_CASE("a solver finds the same root whatever it solved before", "[integrators][sundials]") {
  const Context context;
  const double absolute = 1e-9;
  for (const CvodeMethod method : {CvodeMethod::bdf, CvodeMethod::adams}) {
    CvodeSolver solver(context, 1, method);
    // One step: CVODE left a function that had been zero all along off the watch in the first step of the
    // next solve, too.
    const CvodeSolver::Settings settings{1e-6, &absolute, 1.0, 1.0, 1000};
    for (const bool zero_before : {false, true, true, false}) {
      Ramp ramp;
      double y = 0.0;
      if (zero_before) {
        ramp.always_zero = true;
        const auto r = solver.solve(ramp, &y, 1.0, settings);
        REQUIRE(!r.failed());
        CHECK(r.root == -1);
        CHECK(y == Approx(1.0));
        ramp.always_zero = false;
      }
      y = 0.0;
      const auto r = solver.solve(ramp, &y, 1.0, settings);
      REQUIRE(!r.failed());
      CHECK(r.root == 0);
      CHECK(r.time == Approx(0.5));
      CHECK(y == Approx(0.5));
    }
  }
}
