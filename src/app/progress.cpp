#include "app/progress.hpp"

#include "app/messages.hpp"
#include "app/progress_line.hpp"
#include "app/terminal.hpp"

namespace vitrum::app {

Progress::Progress(double start, double end, const char* energy_unit, bool quiet)
    : start_(start),
      end_(end),
      first_time_(start),
      energy_unit_(energy_unit),
      draws_(!quiet && on_terminal()),
      tells_(!quiet && !draws_),
      begun_(Clock::now()),
      last_(begun_) {}

void Progress::begin(double time) {
  first_time_ = time;
  begun_ = last_ = Clock::now();
}

void Progress::draw(double time, double step, const IntegratorCounters& c, const EnergyTotals& energy) {
  last_ = Clock::now();
  drawn_ = true;
  const double seconds = std::chrono::duration<double>(last_ - begun_).count();
  const double left = time > first_time_ ? seconds * (end_ - time) / (time - first_time_) : 0.0;
  // Not into the last column, behind which some terminals begin another line; and the cursor goes back: where
  // a window that becomes narrower breaks the line, it stays with the first part, and all of it is cleared.
  const std::size_t columns = terminal_columns() - 1;
  tell(
      "\r{}\033[J\r",
      progress_line({(time - start_) / (end_ - start_), left, time, step, c, energy, energy_unit_}, columns));
}

void Progress::output(double time, const IntegratorCounters& c, const EnergyTotals& e) {
  if (!tells_) return;
  tell("t = {:.4g} us  steps {}  rejected {}  kinetic {:.4g} {}  elastic {:.4g} {}  residual {:+.2f} %\n",
       1e6 * time, c.steps, c.rejected, e.kinetic, energy_unit_, e.elastic, energy_unit_,
       100.0 * e.relative_residual());
}

void Progress::finish() {
  if (drawn_) tell("\r\033[J");
  drawn_ = false;
}

}  // namespace vitrum::app
