#pragma once
#include "app/warnings.hpp"

namespace vitrum::app {

/// Loads that come after the end of the run, or are over before its start.
void warn_of_idle_loads(const Scene& scene, const System& system, Warnings& list);

}  // namespace vitrum::app
