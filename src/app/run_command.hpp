#pragma once
#include <string>
#include <vector>

namespace vitrum::app {

struct RunOptions {
  std::string scene;
  std::vector<std::string> overrides;
  std::string directory;  ///< empty: out/NAME-OF-SCENE
  int threads = 0;        ///< 0: by the number of particles
  bool resume = false, force = false, no_fields = false, quiet = false;
  std::string program;  ///< as the command names it
  std::string command;  ///< as typed
};

/// The command that goes on with a run from its checkpoint, as a shell takes it in the same working
/// directory.
std::string resuming_command(const RunOptions& options);

/// `vitrum run`: runs a scene and leaves summary.json, result.h5, result.xdmf, energy.csv in the folder;
/// returns the exit status.
int run_scene(const RunOptions& options);

}  // namespace vitrum::app
