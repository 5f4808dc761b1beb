#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "integrators/grid/grid_integrator.hpp"
#include "integrators/sundials/ark_solver.hpp"

namespace vitrum {

/// The shortest step worth trying: 1e-9 of the critical one, and above the rounding of the time. s
double shortest_sensible_step(double critical_step, double time, double target);

/// Throws ComputationError where a step (s, of the key named) cannot be told from the rounding of the time.
void require_above_rounding(double step, const char* key, double time, double target);

/// Enters the solver's work so far into the counters of a run, also that of a step that failed.
void count_work(const sundials::ArkSolver::Counters& work, const IntegratorCounters& before,
                IntegratorCounters& counters);
/// Why a step was not accepted: with a fixed step, at a shortest step that the scene names, or collapsed.
std::string failed_step(const sundials::ArkSolver::Step& step, const std::optional<double>& fixed,
                        const std::optional<double>& shortest, double critical_step);

/// Enters a step and the solver's work into the counters of a run. before: the counters when the solver was
/// made; stability: what is to blame where the method's stability limits the step.
void count_step(const sundials::ArkSolver::Step& step, const sundials::ArkSolver::Counters& work,
                const IntegratorCounters& before, bool fixed, IntegratorCounters& counters,
                StepLimit stability = StepLimit::stability);

/// The first value that is not finite.
std::optional<std::size_t> first_not_finite(const double* values, std::size_t size);

/// The unknown with the largest weighted value.
std::size_t worst_unknown(const double* values, const double* weights, std::size_t size);

}  // namespace vitrum
