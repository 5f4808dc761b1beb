#pragma once
#include <cstdint>
#include <vector>

#include "integrators/grid/grid_integrator.hpp"
#include "observe/archive.hpp"

namespace vitrum::app {

/// What a run remembers besides its particles and its observers.
struct RunState {
  std::vector<double> coasting;  ///< by body: 1 where it coasts, else 0
  std::vector<double> removed;   ///< mpm::removed_counts
  std::vector<double> contact;   ///< mpm::Contact::state
  IntegratorState integrator;
  std::int64_t outputs = 0;       ///< planned outputs written, the one at the start not counted
  std::int64_t checkpoints = 0;   ///< planned checkpoints written
  std::int64_t result_steps = 0;  ///< steps in result.h5
  std::int64_t evaluations = 0, events = 0;
  double last_step = 0.0;  ///< s
  SolverCounters solver;
  double wall_seconds = 0.0;     ///< in the time loop
  double earlier_seconds = 0.0;  ///< of the processes that this run goes on from, from start to checkpoint
};

/// Enters the state into an archive, and takes it out again. Throws FileError for one that lacks a number.
void save(const RunState& state, Archive& archive);
RunState restored(const Archive& archive, std::size_t bodies);

}  // namespace vitrum::app
