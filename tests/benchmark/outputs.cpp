// Writing of results and checkpoints. items: particles.
#include <benchmark/benchmark.h>

#include <filesystem>

#include "benchmark/running_scene.hpp"
#include "output/checkpoint.hpp"
#include "output/particle_fields.hpp"
#include "output/result_file.hpp"

namespace vitrum::benchmarks {
namespace {

/// A directory for the files of one benchmark.
struct Directory {
  Directory() {
    std::string name = (std::filesystem::temp_directory_path() / "vitrum-benchmark-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary directory");
    path = name;
  }
  ~Directory() { std::filesystem::remove_all(path); }
  std::filesystem::path path;
};

/// One output of all fields.
void result_output(benchmark::State& state) {
  const Scene scene = bar(state.range(0));
  RunningScene run(scene);
  const auto& bodies = run.system.bodies;
  const auto fields = output::select_fields(std::nullopt, output::materials_of(bodies), "output.fields");
  const Directory directory;
  output::ResultFile file = output::ResultFile::create(
      directory.path, {scene.title, scene.verbatim, "", output::make_provenance("benchmark", ""),
                       output::particle_constants(bodies, scene.geometry)});
  output::OutputFrame frame;
  for ([[maybe_unused]] auto _ : state) {
    frame.time += 1e-6, ++frame.step_index;
    frame.fields = output::particle_fields(bodies, fields, scene.geometry);
    file.append(frame);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(run.system.particle_count()));
}
BENCHMARK(result_output)->ArgName("thousand")->Arg(1)->Arg(80)->Unit(benchmark::kMillisecond)->UseRealTime();

void checkpoint(benchmark::State& state) {
  RunningScene run(bar(state.range(0)));
  const Directory directory;
  const output::Checkpoint all{0.0, 0, "", output::checkpoint_bodies(run.system.bodies), {}};
  for ([[maybe_unused]] auto _ : state) output::write_checkpoint(directory.path / "checkpoint.h5", all);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(run.system.particle_count()));
}
BENCHMARK(checkpoint)->ArgName("thousand")->Arg(1)->Arg(80)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace vitrum::benchmarks
