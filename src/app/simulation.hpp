#pragma once
#include <chrono>
#include <filesystem>
#include <optional>

#include "analysis/energy_ledger.hpp"
#include "analysis/failure.hpp"
#include "app/progress.hpp"
#include "app/run_command.hpp"
#include "app/run_state.hpp"
#include "app/schedule.hpp"
#include "app/watchdog.hpp"
#include "output/energy_csv.hpp"
#include "output/result_file.hpp"
#include "output/summary.hpp"

namespace vitrum::app {

/// One run of a scene: steps from target to target, books energies, watches stability, writes outputs and
/// checkpoints.
class Simulation final : private StepObserver {
 public:
  /// Starts, or resumes from directory/checkpoint.h5. Throws InputError, FileError.
  Simulation(const Scene& scene, System system, const RunOptions& options, std::filesystem::path directory);

  /// To the end, to a failure, or to a signal; writes the summary; returns the exit status.
  int run();

 private:
  bool step_done(System& system, double step) override;
  void start();
  void resume();
  bool ended() const;
  bool advance_to(double target);
  void write_output();
  void write_checkpoint();
  void write_energy_row();
  std::vector<output::SeriesValue> series() const;
  int finish(output::RunStatus status, const std::string& message, int exit_status);
  output::RunSummary summary(output::RunStatus status, const std::string& message) const;
  void print_summary(const output::RunSummary& summary) const;
  EnergyTotals shown_energy() const { return scaled(ledger_.totals(), whole_); }

  const Scene& scene_;
  RunOptions options_;
  std::filesystem::path directory_;
  System system_;
  double whole_;  ///< 2 pi in axisymmetric scenes: files show the whole body
  std::unique_ptr<GridIntegrator> integrator_;
  EnergyLedger ledger_;
  FailureAnalysis failure_;
  Watchdog watchdog_;
  Schedule schedule_;
  Progress progress_;
  std::vector<std::string> fields_;
  output::Provenance provenance_;
  std::optional<output::ResultFile> result_;
  std::optional<output::EnergyCsv> energy_csv_;
  RunState state_;
  std::optional<std::string> failed_;
  double last_step_ = 0.0;
};

}  // namespace vitrum::app
