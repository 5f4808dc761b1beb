#pragma once
#include "mpm/system.hpp"

namespace vitrum::mpm {

/// Judges the states that the bodies start from (Material::judge): what their initial stress asks for happens
/// at the start, whether or not anything moves. system.record tells what it dissipates, and the events.
void judge_initial_states(System& system);

}  // namespace vitrum::mpm
