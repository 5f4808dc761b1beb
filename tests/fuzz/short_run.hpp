#pragma once
#include "scene/scene.hpp"

namespace vitrum::fuzz {

/// What a scene goes through in a fuzz target: its resolved form reads as the same scene; when it is small,
/// the system is built, what `check` derives is derived, and a few steps are taken under the watchdog.
void exercise(const Scene& scene);

}  // namespace vitrum::fuzz
