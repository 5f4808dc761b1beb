#pragma once
#include <cstdint>

#include "integrators/grid/grid_integrator.hpp"
#include "integrators/sundials/ark_solver.hpp"

namespace vitrum {

/// The shortest step worth trying: 1e-9 of the critical one, and above the rounding of the time. s
double shortest_sensible_step(double critical_step, double time, double target);

/// Enters a step and the solver's work into the counters of a run. before: the counters when the solver was
/// made.
void count_step(const sundials::ArkSolver::Step& step, const sundials::ArkSolver::Counters& work,
                const IntegratorCounters& before, bool fixed, IntegratorCounters& counters);

/// The unknown with the largest weighted value.
std::size_t worst_unknown(const double* values, const double* weights, std::size_t size);

}  // namespace vitrum
