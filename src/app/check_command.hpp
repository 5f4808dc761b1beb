#pragma once
#include <string>
#include <vector>

#include "mpm/system.hpp"
#include "scene/scene.hpp"

namespace vitrum::app {

struct CheckOptions {
  std::string scene;
  std::vector<std::string> overrides;
  bool json = false;
};

/// `vitrum check`: validates, prints derived quantities, warnings and the resolved scene; runs nothing.
int check_scene(const CheckOptions& options);

/// What a user should know before running: a step beyond the critical one, a crack law that snaps back, ...
/// threads: that a run uses.
std::vector<std::string> warnings(const Scene& scene, const System& system, int threads);

}  // namespace vitrum::app
