// Steps of the momentum equations and the right-hand sides and linear algebra behind the adaptive ones.
#include <benchmark/benchmark.h>

#include <cmath>

#include "benchmark/running_scene.hpp"
#include "integrators/grid/grid_system.hpp"
#include "integrators/grid/particle_system.hpp"
#include "integrators/sundials/reduced_solver.hpp"

namespace vitrum::benchmarks {
namespace {

const char* const schemes[] = {"usf", "usl", "musl"};

void count_particles(benchmark::State& state, const System& system, int steps = 1) {
  state.SetItemsProcessed(steps * state.iterations() * static_cast<std::int64_t>(system.particle_count()));
}

/// The bar with 20,480 particles. items: particle-steps.
void explicit_step(benchmark::State& state) {
  const char* scheme = schemes[state.range(0)];
  state.SetLabel(scheme);
  const Scene scene = bar(20, {std::string("integrator.scheme=\"") + scheme + "\""});
  RunningScene run(scene);
  run.advance(2, scene.end);
  for ([[maybe_unused]] auto _ : state) run.advance(1, scene.end);
  count_particles(state, run.system);
}
BENCHMARK(explicit_step)->ArgName("scheme")->DenseRange(0, 2)->Unit(benchmark::kMicrosecond);

/// The particle system's right-hand side for the same bar: to be compared with an explicit step.
void arkode_explicit_rhs(benchmark::State& state) {
  const Scene scene = bar(20);
  RunningScene run(scene);
  run.advance(2, scene.end);
  ParticleSystem particles(run.system, error_scales(run.system, {}), 1e-3, 1.0);
  const std::size_t unknowns = particles.size() + particles.integrals();
  std::vector<double> y(unknowns), rates(unknowns);
  particles.begin(y.data());
  double t = run.system.time;
  const double step = 1e-9;
  bool finite = particles.rates(t, y.data(), rates.data());
  for (std::size_t i = 0; i < y.size(); ++i)
    y[i] += step * rates[i];  // off the committed state: stress is computed
  t += step;
  for ([[maybe_unused]] auto _ : state) finite = finite && particles.rates(t, y.data(), rates.data());
  if (!finite) state.SkipWithError("a rate is not finite");
  count_particles(state, run.system);
}
BENCHMARK(arkode_explicit_rhs)->Unit(benchmark::kMicrosecond);

/// The grid system's parts in the order of an implicit step, for a bar of 1,280 to 81,920 particles.
struct ImplicitParts {
  explicit ImplicitParts(long thousands)
      : scene(bar(thousands)), run(scene), grid(run.system, error_scales(run.system, {}), 1e-3) {
    grid.begin_phase();
    y.resize(grid.size() + grid.integrals()), rates.resize(y.size());
    grid.start(y.data());
    solver = std::make_unique<sundials::ReducedSolver>(context, grid, sundials::ReducedSolver::Kind::factor);
    t = run.system.time + 1e-12;
    gamma = 10.0 * *scene.integrator.step;  // ten times the explicit step
    grid.rates(t, y.data(), rates.data());
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += 1e-9 * rates[i];
    solver->form(t, y.data(), gamma, false);
    solver->factor();
  }
  Scene scene;
  RunningScene run;
  GridSystem grid;
  sundials::Context context;
  std::unique_ptr<sundials::ReducedSolver> solver;
  std::vector<double> y, rates;
  double t = 0.0, gamma = 0.0;
};

template <class Part>
void time_part(benchmark::State& state, Part&& part) {
  ImplicitParts parts(state.range(0));
  for ([[maybe_unused]] auto _ : state) part(parts);
  state.counters["unknowns"] = static_cast<double>(parts.grid.pattern().size());
  state.counters["factor_entries"] = static_cast<double>(parts.solver->factor_entries());
  count_particles(state, parts.run.system);
}
void arkode_implicit_rhs(benchmark::State& state) {
  time_part(state, [](ImplicitParts& p) { p.grid.rates(p.t, p.y.data(), p.rates.data()); });
}
void implicit_linearise(benchmark::State& state) {
  time_part(state, [](ImplicitParts& p) { p.solver->form(p.t, p.y.data(), p.gamma, false); });
}
void klu_factor(benchmark::State& state) {
  time_part(state, [](ImplicitParts& p) { p.solver->factor(); });
}
void klu_solve(benchmark::State& state) {
  // Values everywhere: what one end of the bar alone knows of dies out along it, down to where numbers are
  // slow.
  std::vector<double> b, x;
  time_part(state, [&](ImplicitParts& p) {
    for (std::size_t k = b.size(); k < p.y.size(); ++k) b.push_back(std::sin(static_cast<double>(k)));
    x.resize(p.y.size());
    p.solver->solve(b.data(), x.data());
  });
}
BENCHMARK(arkode_implicit_rhs)->ArgName("thousand")->Arg(1)->Arg(5)->Arg(20)->Arg(80)->Unit(benchmark::kMicrosecond);
BENCHMARK(implicit_linearise)->ArgName("thousand")->Arg(1)->Arg(5)->Arg(20)->Arg(80)->Unit(benchmark::kMicrosecond);
BENCHMARK(klu_factor)->ArgName("thousand")->Arg(1)->Arg(5)->Arg(20)->Arg(80)->Unit(benchmark::kMicrosecond);
BENCHMARK(klu_solve)->ArgName("thousand")->Arg(1)->Arg(5)->Arg(20)->Arg(80)->Unit(benchmark::kMicrosecond);

/// Whole implicit steps of a bar, for the share of the parts.
void arkode_implicit_step(benchmark::State& state) {
  const Scene scene = bar(state.range(0), {"integrator.method=\"arkode-implicit\""});
  RunningScene run(scene);
  const double target = 1e-3;
  run.advance(3, target);
  const std::int64_t factorised = run.integrator->state().counters.factorisations,
                     evaluated = run.integrator->state().counters.rhs_evaluations,
                     solved = run.integrator->state().counters.newton_iterations,
                     begun = run.integrator->state().counters.steps;
  // As a run does, which asks for many steps at a time: who asks anew has the factors made anew.
  constexpr int steps = 20;
  for ([[maybe_unused]] auto _ : state) run.advance(steps, target);
  const IntegratorCounters& c = run.integrator->state().counters;
  const auto per_step = [&](std::int64_t now, std::int64_t then) {
    return static_cast<double>(now - then) / static_cast<double>(c.steps - begun);
  };
  state.counters["factorisations"] = per_step(c.factorisations, factorised);
  state.counters["rhs"] = per_step(c.rhs_evaluations, evaluated);
  state.counters["solves"] = per_step(c.newton_iterations, solved);
  count_particles(state, run.system, steps);
}
BENCHMARK(arkode_implicit_step)->ArgName("thousand")->Arg(1)->Arg(5)->Arg(20)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace vitrum::benchmarks
