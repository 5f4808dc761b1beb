#include "app/run_command.hpp"

#include "app/demands.hpp"
#include "app/messages.hpp"
#include "app/run_folder.hpp"
#include "app/signals.hpp"
#include "app/simulation.hpp"
#include "app/warnings.hpp"
#include "output/particle_fields.hpp"
#include "scene/build_system.hpp"
#include "scene/input_text.hpp"
#include "scene/read_scene.hpp"

namespace vitrum::app {

std::string resuming_command(const RunOptions& options) {
  // A file whose name begins like an option is one behind "./" alone.
  const auto path = [](const std::string& name) {
    return shell_quoted(name.starts_with('-') ? "./" + name : name);
  };
  std::string text = fmt::format("{} run {}", shell_quoted(options.program), path(options.scene));
  for (const std::string& assignment : options.overrides) text += " --set " + shell_quoted(assignment);
  if (!options.directory.empty()) text += " --out " + path(options.directory);
  if (options.threads != 0) text += fmt::format(" --threads {}", options.threads);
  if (options.no_fields) text += " --no-fields";
  if (options.quiet) text += " --quiet";
  return text + " --resume";
}

int run_scene(const RunOptions& options) {
  survive_failing_writes();
  if (options.scene == "-")
    throw InputError(
        "SCENE: found -, expected a file: a run that goes on from its checkpoint reads its scene again, "
        "which "
        "standard input gives once; `vitrum check -` and `vitrum point -` take it");
  const InputText input = show_lines_of(read_input(options.scene), options.overrides);
  const Scene scene = parse_scene(input.text, input.name, options.overrides);
  require_memory(scene, size_of(scene));
  System system = build_system(scene, options.threads);
  const int threads = system.team->size();
  require_time(scene, system, work_of(scene, system, threads), threads);
  require_clock(scene, system);
  Warnings warned = warnings(scene, system, threads);
  for (const std::string& w : warned) warn(w);
  // Before the folder is made: wrong input leaves no trace.
  output::select_fields(scene, output::materials_of(system.bodies));
  require_disk(scene, disk_space_of(scene, system, !options.no_fields), folder_of(options));
  Simulation simulation(scene, std::move(system), options, claim_folder(options), std::move(warned));
  return simulation.run();
}

}  // namespace vitrum::app
