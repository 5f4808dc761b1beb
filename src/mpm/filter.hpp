#pragma once
#include "mpm/system.hpp"

namespace vitrum::mpm {

/// Takes out of the particles' pressures what nodes do not see, where System::filters asks for it and a
/// filter is due between two times, s: (1 - S)^4 of the trace of the elastic strain, S the average over cells
/// (cell_average.hpp). It bears no force on nodes but would stay for ever; the energy that it stored is
/// removed and booked (StepRecord::filtered). A filter is due every ten cells that a wave runs through.
/// Material that has cracks, or that tension would damage, keeps its pressure. Returns whether something has
/// changed.
bool filter_pressures(System& system, double from, double to);

/// Energy of pressures that differ from their average over cells, J (per radian or per metre): where waves
/// have died away, what particles of a cell store against each other.
double ringing_energy(const System& system);

}  // namespace vitrum::mpm
