// What the machine allows, measured: the ceilings of the roofline. items: flops; bytes: those that triad
// names, and the line that a store reads first.
#include <benchmark/benchmark.h>

#include <vector>

namespace vitrum::benchmarks {
namespace {

void memory_triad(benchmark::State& state) {
  constexpr std::size_t size = std::size_t{1} << 24;  // 3 x 128 MB: far beyond every cache
  std::vector<double> a(size, 0.0), b(size, 1.0), c(size, 2.0);
  double factor = 3.0;
  for ([[maybe_unused]] auto _ : state) {
    double *to = a.data(), *x = b.data(), *y = c.data();
#pragma GCC ivdep
    for (std::size_t i = 0; i < size; ++i) to[i] = x[i] + factor * y[i];
    benchmark::DoNotOptimize(to);
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(4 * size * sizeof(double)));
}
BENCHMARK(memory_triad)->Unit(benchmark::kMillisecond);

/// Independent chains of x = x f + g, enough to fill the pipelines.
template <int width, int chains>
void multiply_and_add(benchmark::State& state) {
  using Lanes = double __attribute__((vector_size(sizeof(double) * width)));
  Lanes x[chains];
  double factor = 0.999, term = 1e-3;
  benchmark::DoNotOptimize(factor);
  benchmark::DoNotOptimize(term);
  for (Lanes& lane : x) lane = Lanes{} + 1.0;
  constexpr int turns = 10000;
  for ([[maybe_unused]] auto _ : state) {
    for (int i = 0; i < turns; ++i)
#pragma GCC unroll 16
      for (int c = 0; c < chains; ++c) x[c] = x[c] * factor + term;
    for (Lanes& lane : x) benchmark::DoNotOptimize(lane);
  }
  state.SetItemsProcessed(state.iterations() * 2 * width * chains * std::int64_t{turns});
}
void peak_scalar(benchmark::State& state) {
  multiply_and_add<1, 12>(state);
}
void peak_vector(benchmark::State& state) {
  multiply_and_add<8, 12>(state);
}
BENCHMARK(peak_scalar);
BENCHMARK(peak_vector);

}  // namespace
}  // namespace vitrum::benchmarks
