#include "app/progress.hpp"

#include <unistd.h>

#include <array>
#include <string>

#include "app/messages.hpp"

namespace vitrum::app {

Progress::Progress(double start, double end, const char* energy_unit, bool quiet)
    : start_(start),
      end_(end),
      energy_unit_(energy_unit),
      quiet_(quiet),
      terminal_(isatty(STDERR_FILENO) == 1),
      begun_(Clock::now()),
      last_(begun_) {
  first_time_ = start;
}

void Progress::step(double time, double step, const IntegratorCounters& c) {
  if (quiet_ || !terminal_ || ++calls_ % 64 != 0) return;
  const Clock::time_point now = Clock::now();
  if (now - last_ < std::chrono::milliseconds(200)) return;
  last_ = now;
  drawn_ = true;
  const double part = (time - start_) / (end_ - start_), computed = (time - first_time_) / (end_ - start_);
  const double seconds = std::chrono::duration<double>(now - begun_).count();
  const double left = computed > 0.0 ? seconds / computed * (1.0 - part) : 0.0;
  const auto filled = static_cast<std::size_t>(part * 30.0);
  constexpr std::array limits{"fixed step", "stability", "accuracy", "output", "remap"};
  const char* limit = limits[static_cast<std::size_t>(c.last_limit)];
  tell(
      "\r[{:<30}] {:3.0f} %  t = {:.2f} us  dt = {:.4f} us  {} steps, {} rejected  limit: {}  {:.0f} s left ",
      std::string(std::min<std::size_t>(filled, 30), '#'), 100.0 * part, 1e6 * time, 1e6 * step, c.steps,
      c.rejected, limit, left);
}

void Progress::output(double time, const IntegratorCounters& c, const EnergyTotals& e) {
  if (quiet_ || terminal_) return;
  tell("t = {:.4g} us  steps {}  rejected {}  kinetic {:.4g} {}  elastic {:.4g} {}  residual {:+.2f} %\n",
       1e6 * time, c.steps, c.rejected, e.kinetic, energy_unit_, e.elastic, energy_unit_,
       100.0 * e.relative_residual());
}

void Progress::finish() {
  if (drawn_) tell("\r\033[K");
  drawn_ = false;
}

}  // namespace vitrum::app
