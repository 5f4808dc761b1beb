#pragma once
#include <chrono>
#include <filesystem>
#include <optional>

#include "app/machine.hpp"
#include "app/progress.hpp"
#include "app/run_command.hpp"
#include "app/run_state.hpp"
#include "app/schedule.hpp"
#include "app/table_files.hpp"
#include "app/warnings.hpp"
#include "app/watchdog.hpp"
#include "mpm/computation_error.hpp"
#include "observe/energy_ledger.hpp"
#include "observe/failure.hpp"
#include "observe/observers.hpp"
#include "output/checkpoint.hpp"
#include "output/folder_lock.hpp"
#include "output/result_file.hpp"
#include "output/summary.hpp"

namespace vitrum::app {

/// One run of a scene: steps from target to target, lets observers look on, watches stability, writes outputs
/// and checkpoints.
class Simulation final : private StepObserver {
 public:
  /// Starts in a folder without a run, or resumes from its checkpoint.h5. Throws InputError, FileError.
  /// warned: what was told before, for the summary.
  Simulation(const Scene& scene, System system, const RunOptions& options, output::FolderLock folder,
             Warnings warned);

  /// To the end, to a failure, to a signal, or until something cannot be written; writes the summary; returns
  /// the exit status.
  int run();

 private:
  bool step_done(System& system, double step) override;
  void start();
  void resume();
  [[noreturn]] void refuse_scene(const output::Checkpoint& checkpoint) const;
  int run_to_end();
  int give_up(const std::string& cause);
  bool ended() const;
  bool advance_to(double target);
  std::string keep_failed_point(const PointFailure& failure);
  void require_folder();
  void write_output();
  void write_checkpoint();
  std::vector<Quantity> series() const;
  int finish(output::RunStatus status, std::string message, int exit_status);
  int conclude(output::RunStatus status, const std::string& message, int exit_status);
  output::RunSummary summary(output::RunStatus status, const std::string& message) const;
  std::string summary_text(const output::RunSummary& summary) const;
  Warnings closing_warnings(const output::RunSummary& summary) const;
  /// Of this process, and of those that it goes on from.
  double total_seconds() const { return state_.earlier_seconds + process_seconds(); }
  EnergyTotals shown_energy() const { return scaled(ledger_.totals(), whole_); }

  const Scene& scene_;
  RunOptions options_;
  output::FolderLock folder_;
  std::filesystem::path directory_;
  System system_;
  double whole_;  ///< 2 pi in axisymmetric scenes: files show the whole body
  std::unique_ptr<GridIntegrator> integrator_;
  Observers observers_;
  EnergyLedger& ledger_;
  FailureAnalysis& failure_;
  Watchdog watchdog_;
  Schedule schedule_;
  Progress progress_;
  std::vector<std::string> fields_;
  output::Provenance provenance_;
  std::optional<output::ResultFile> result_;
  TableFiles tables_;
  RunState state_;
  Warnings warned_;  ///< before the run
  std::optional<std::string> failed_;
  std::optional<std::string> unwritten_;  ///< why rows of a table could not be written
};

}  // namespace vitrum::app
