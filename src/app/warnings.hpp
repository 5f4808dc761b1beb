#pragma once
#include <string>
#include <vector>

#include "mpm/system.hpp"
#include "scene/scene.hpp"

namespace vitrum::app {

/// One line each, without "warning: "; a warning of a key begins as an error does (Scene::at).
using Warnings = std::vector<std::string>;

/// What a user should know before running: what reading the scene found implausible, a step beyond the
/// critical one, a crack law that snaps back, ... threads: that a run uses.
Warnings warnings(const Scene& scene, const System& system, int threads);

}  // namespace vitrum::app
