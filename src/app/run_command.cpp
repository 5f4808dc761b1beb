#include "app/run_command.hpp"

#include "app/demands.hpp"
#include "app/messages.hpp"
#include "app/run_folder.hpp"
#include "app/signals.hpp"
#include "app/simulation.hpp"
#include "app/warnings.hpp"
#include "output/particle_fields.hpp"
#include "scene/build_system.hpp"
#include "scene/read_scene.hpp"

namespace vitrum::app {

int run_scene(const RunOptions& options) {
  survive_failing_writes();
  const Scene scene = read_scene(options.scene, options.overrides);
  require_memory(scene, size_of(scene));
  System system = build_system(scene, options.threads);
  const int threads = system.team->size();
  require_time(scene, system, work_of(scene, system, threads), threads);
  Warnings warned = warnings(scene, system, threads);
  for (const std::string& w : warned) tell("warning: {}\n", w);
  // Before the folder is made: wrong input leaves no trace.
  output::select_fields(scene, output::materials_of(system.bodies));
  require_disk(scene, disk_space_of(scene, system, !options.no_fields), folder_of(options));
  Simulation simulation(scene, std::move(system), options, claim_folder(options), std::move(warned));
  return simulation.run();
}

}  // namespace vitrum::app
