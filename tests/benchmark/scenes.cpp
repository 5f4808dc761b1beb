// Whole scenes, with the bookkeeping of a run and without output. items: particle-steps.
#include <benchmark/benchmark.h>

#include <initializer_list>
#include <utility>

#include "benchmark/running_scene.hpp"

namespace vitrum::benchmarks {
namespace {

/// Steps of a scene that costs the same from step to step.
void take_steps(benchmark::State& state, const Scene& scene, int threads) {
  RunningScene run(scene, threads);
  run.advance(2, scene.end);  // first touch of memory
  for ([[maybe_unused]] auto _ : state) run.advance(1, scene.end);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(run.system.particle_count()));
  state.counters["particles"] = static_cast<double>(run.system.particle_count());
}

/// A whole run: its cost changes as things break.
void run_through(benchmark::State& state, const Scene& scene) {
  std::int64_t work = 0;
  for ([[maybe_unused]] auto _ : state) {
    state.PauseTiming();
    RunningScene run(scene);
    state.ResumeTiming();
    run.advance(1 << 30, scene.end);
    work += run.system.step_index * static_cast<std::int64_t>(run.system.particle_count());
  }
  state.SetItemsProcessed(work);
}

void elastic_bar(benchmark::State& state) {
  take_steps(state, bar(state.range(0)), static_cast<int>(state.range(1)));
}
BENCHMARK(elastic_bar)
    ->ArgNames({"thousand", "threads"})
    ->ArgsProduct({{1, 20, 80, 500}, {1, 2}})
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime();

void colliding_disks(benchmark::State& state) {
  take_steps(state, disks(state.range(0)), static_cast<int>(state.range(1)));
}
/// Their steps differ: each size is followed over the same ones, whatever the number of threads.
const bool followed = [] {
  for (const auto& [thousands, steps] :
       std::initializer_list<std::pair<long, long>>{{1, 8000}, {20, 1500}, {80, 300}, {500, 160}})
    for (const long threads : {1L, 2L})
      benchmark::RegisterBenchmark("colliding_disks", colliding_disks)
          ->ArgNames({"thousand", "threads"})
          ->Args({thousands, threads})
          ->Iterations(steps)
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
  return true;
}();

void reference_run(benchmark::State& state) {
  run_through(state, reference_case());
}
BENCHMARK(reference_run)->Unit(benchmark::kMillisecond)->Iterations(1);

/// The largest of the paper's plates at its highest velocity.
void large_plate(benchmark::State& state) {
  run_through(state,
              reference_case({"body.0.box.max.0=0.8", "boundary.0.box.min.0=0.8", "boundary.0.box.max.0=0.9",
                              "body.1.velocity.1=-800", "time.start=-3.75e-6", "integrator.step=1.25e-8"}));
}
BENCHMARK(large_plate)->Unit(benchmark::kMillisecond)->Iterations(1);

}  // namespace
}  // namespace vitrum::benchmarks
