#pragma once
#include "app/demands.hpp"
#include "app/warnings.hpp"

namespace vitrum::app {

/// Lengths, times and stresses that are of another order than the scene's: mostly a unit that slipped.
void warn_of_magnitudes(const Scene& scene, const System& system, const Work& work, Warnings& list);

}  // namespace vitrum::app
