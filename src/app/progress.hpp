#pragma once
#include <chrono>

#include "analysis/energy_totals.hpp"
#include "integrators/grid/grid_integrator.hpp"

namespace vitrum::app {

/// Tells how a run gets on: a bar on a terminal, otherwise a line per output. All on standard error.
class Progress {
 public:
  /// energy_unit: "J" or "J/m"; must outlive the object.
  Progress(double start, double end, const char* energy_unit, bool quiet);

  /// After a step; looks at the clock only now and then.
  void step(double time, double step, const IntegratorCounters& counters);
  /// After an output.
  void output(double time, const IntegratorCounters& counters, const EnergyTotals& energy);
  /// Clears the bar.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  double start_, end_;
  const char* energy_unit_;
  bool quiet_, terminal_, drawn_ = false;
  unsigned calls_ = 0;
  double first_time_ = 0.0;
  Clock::time_point begun_, last_;
};

}  // namespace vitrum::app
