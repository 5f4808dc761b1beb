#include "app/run_command.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "app/check_command.hpp"
#include "app/demands.hpp"
#include "app/simulation.hpp"
#include "output/particle_fields.hpp"
#include "scene/build_system.hpp"
#include "scene/read_scene.hpp"

namespace vitrum::app {

int run_scene(const RunOptions& options) {
  const Scene scene = read_scene(options.scene, options.overrides);
  require_memory(scene, size_of(scene));
  System system = build_system(scene, options.threads);
  const int threads = system.team->size();
  require_time(scene, system, work_of(scene, system, threads), threads);
  for (const std::string& w : warnings(scene, system, threads)) fmt::print(stderr, "warning: {}\n", w);

  const std::filesystem::path directory =
      options.directory.empty() ? std::filesystem::path("out") / std::filesystem::path(options.scene).stem()
                                : std::filesystem::path(options.directory);
  // Before the folder is made: wrong input leaves no trace.
  output::select_fields(scene.output.fields, output::materials_of(system.bodies));
  require_disk(scene, disk_space_of(scene, system, !options.no_fields), directory);
  std::error_code error;
  std::filesystem::create_directories(directory, error);
  if (error) throw FileError(fmt::format("{}: cannot be made: {}", directory.string(), error.message()));

  Simulation simulation(scene, std::move(system), options, directory);
  return simulation.run();
}

}  // namespace vitrum::app
