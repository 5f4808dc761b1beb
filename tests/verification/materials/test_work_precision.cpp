#include <algorithm>
#include <chrono>
#include <cstdio>

#include "catch.hpp"
#include "support/local_solvers.hpp"
#include "support/material_samples.hpp"
#include "support/random_states.hpp"
#include "support/strain_path.hpp"

using namespace vitrum;
using namespace vitrum::test;

// Run by hand: tests_verification "[work-precision]" prints the table of docs/reports/findings.md.
TEST_CASE("work and precision of the three methods", "[.][work-precision]") {
  struct Work {
    const char* name;
    MaterialParameters material;
    std::vector<Segment> before, increment;
  };
  MaterialParameters viscous = fracturing_glass();
  viscous.decohesion->viscosity = 1e-9;
  const double r = 3.0e3;
  const std::vector<Work> works{
      {"elastic", fracturing_glass(), {}, {{{-1e-4, 0, 0, 2e-5}, 1e-7}}},
      {"damaging",
       fracturing_glass(),
       {{{1.1e-3, 1e-5, 0, 0}, 1.1e-3 / r}},
       {{{2e-4, 1e-5, 0, 3e-5}, 2e-4 / r}}},
      {"plastic", flowing_steel(), {{{2e-3, -1e-3, -1e-3, 0}, 1e-6}}, {{{1e-4, 0, -1e-4, 3e-4}, 1e-7}}},
      {"decohering", fracturing_glass(), {{{2e-3, 0, 0, 0}, 2e-3 / r}}, {{{3e-4, 0, 0, 2e-4}, 3e-4 / r}}},
      {"viscous", viscous, {{{2e-3, 0, 0, 0}, 2e-3 / r}}, {{{3e-4, 0, 0, 2e-4}, 3e-4 / r}}},
  };
  std::printf("| increment | method | tolerance or steps | error | us |\n|---|---|---|---|---|\n");
  for (const Work& work : works) {
    const auto material = composite_of(work.material, cell);
    Cvode tight({1e-13, 1e-15}, CvodeFamily::bdf);
    const CompositeState start =
        work.before.empty() ? CompositeState{} : drive(*material, work.before, 1, {}, &tight).state;
    const Driven reference = drive(*material, work.increment, 1, start, &tight);
    const double scale = std::max(norm(reference.state.stress - start.stress), 1.0);
    const auto measure = [&](const std::string& method, const std::string& setting,
                             PointIntegrator* integrator, int steps) {
      std::vector<double> times;
      Driven d;
      for (int repeat = 0; repeat < 5; ++repeat) {
        constexpr int runs = 200;
        const auto begun = std::chrono::steady_clock::now();
        for (int i = 0; i < runs; ++i) d = drive(*material, work.increment, steps, start, integrator);
        times.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - begun).count() /
                        runs);
      }
      std::sort(times.begin(), times.end());
      std::printf("| %s | %s | %s | %.1e | %.2f |\n", work.name, method.c_str(), setting.c_str(),
                  distance(d.state.stress, reference.state.stress) / scale, 1e6 * times[2]);
    };
    for (const int steps : {1, 10, 100}) measure("closed-form", std::to_string(steps), nullptr, steps);
    for (const double rtol : {1e-3, 1e-4, 1e-6, 1e-8, 1e-10})
      for (const LocalSolver& solver : solvers(rtol)) {
        char text[16];
        std::snprintf(text, sizeof text, "%.0e", rtol);
        measure(solver.name, text, solver.integrator.get(), 1);
      }
  }
}
