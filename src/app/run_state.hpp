#pragma once
#include <cstdint>
#include <vector>

#include "analysis/energy_totals.hpp"
#include "analysis/failure.hpp"
#include "integrators/grid/grid_integrator.hpp"
#include "output/checkpoint.hpp"

namespace vitrum::app {

/// All that a run remembers besides its particles.
struct RunState {
  EnergyTotals energy;
  std::vector<FailureAnalysis::Memory> failure;  ///< by body
  std::vector<double> coasting;                  ///< by body: 1 where it coasts, else 0
  std::vector<double> contact;                   ///< mpm::Contact::state
  IntegratorState integrator;
  std::int64_t outputs = 0;       ///< planned outputs written, the one at the start not counted
  std::int64_t checkpoints = 0;   ///< planned checkpoints written
  std::int64_t energy_times = 0;  ///< next planned row of energy.csv
  std::int64_t energy_rows = 0;   ///< rows in energy.csv
  std::int64_t energy_step = 0;   ///< time step of the last of them
  std::int64_t result_steps = 0;  ///< steps in result.h5
  std::int64_t evaluations = 0, events = 0;
  double last_step = 0.0;  ///< s
  SolverCounters solver;
  double wall_seconds = 0.0;     ///< in the time loop
  double earlier_seconds = 0.0;  ///< of the processes that this run goes on from, from start to checkpoint
};

/// Enters the state into a checkpoint, and takes it out again. Throws FileError for a checkpoint that lacks a
/// number.
void store(const RunState& state, output::Checkpoint& checkpoint);
RunState restored(const output::Checkpoint& checkpoint);

}  // namespace vitrum::app
