#pragma once
#include <chrono>

#include "integrators/grid/grid_integrator.hpp"
#include "observe/energy_totals.hpp"

namespace vitrum::app {

/// Tells how a run gets on: a line that is drawn anew on a terminal, otherwise a line per output. All on
/// standard error.
class Progress {
 public:
  /// energy_unit: "J" or "J/m"; must outlive the object.
  Progress(double start, double end, const char* energy_unit, bool quiet);

  /// When the run starts or goes on, at this time of the scene.
  void begin(double time);
  /// Whether it is time to draw; to be asked after every step.
  bool is_due() const { return draws_ && Clock::now() - last_ >= pause; }
  /// Draws the line, as wide as the terminal is now.
  void draw(double time, double step, const IntegratorCounters& counters, const EnergyTotals& energy);
  /// After an output.
  void output(double time, const IntegratorCounters& counters, const EnergyTotals& energy);
  /// Clears the line.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds pause{200};
  double start_, end_, first_time_;
  const char* energy_unit_;
  bool draws_, tells_, drawn_ = false;
  Clock::time_point begun_, last_;
};

}  // namespace vitrum::app
