// The operators between particles and grid, by shape function. items: particles.
#include <benchmark/benchmark.h>

#include "benchmark/running_scene.hpp"
#include "mpm/transfer.hpp"

namespace vitrum::benchmarks {
namespace {

const char* const shapes[] = {"linear", "gimp", "bspline2"};

/// The bar with 20,480 particles after two steps.
RunningScene prepared(benchmark::State& state) {
  const char* shape = shapes[state.range(0)];
  state.SetLabel(shape);
  const Scene scene = bar(20, {std::string("space.shape_functions=\"") + shape + "\""});
  RunningScene run(scene);
  run.advance(2, scene.end);
  mpm::refresh_grid(run.system, mpm::Storage::sorted);
  mpm::scatter(run.system, mpm::Scatter::momentum_and_force, mpm::Nodes::moved, 1e-9);
  return run;
}

template <class Operator>
void time(benchmark::State& state, Operator&& apply) {
  RunningScene run = prepared(state);
  for ([[maybe_unused]] auto _ : state) apply(run.system);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(run.system.particle_count()));
}

void scatter(benchmark::State& state) {
  time(state, [](System& s) { mpm::scatter(s, mpm::Scatter::momentum_and_force); });
}
// A duration of 0 leaves the particles where they are: every pass does the same.
void gather_velocity_and_rescatter(benchmark::State& state) {
  time(state, [](System& s) { mpm::gather(s, mpm::Gather::velocity_and_rescatter, 0.0); });
}
void gather_strain_and_position(benchmark::State& state) {
  time(state, [](System& s) { mpm::gather(s, mpm::Gather::strain_and_position, 0.0); });
}
BENCHMARK(scatter)->ArgName("shape")->DenseRange(0, 2)->Unit(benchmark::kMicrosecond);
BENCHMARK(gather_velocity_and_rescatter)->ArgName("shape")->DenseRange(0, 2)->Unit(benchmark::kMicrosecond);
BENCHMARK(gather_strain_and_position)->ArgName("shape")->DenseRange(0, 2)->Unit(benchmark::kMicrosecond);

/// Sorting all particles into blocks anew.
void rebuild_grid(benchmark::State& state) {
  time(state, [](System& s) {
    s.grid_is_stale = true;
    mpm::refresh_grid(s, mpm::Storage::sorted);
  });
}
BENCHMARK(rebuild_grid)->ArgName("shape")->Arg(0)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace vitrum::benchmarks
