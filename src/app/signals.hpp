#pragma once

namespace vitrum::app {

/// From now on SIGINT, SIGTERM and SIGHUP (unless it is ignored, as nohup asks) are remembered instead of
/// ending the program. A second SIGINT, half a second or more after the first signal, ends it at once: one
/// that follows sooner is the same wish, sent to the process and to its group (as `timeout` does).
void catch_signals();
/// The signal caught first, or 0.
int caught_signal();

/// From now on a pipe that nobody reads and a limit on the size of files make writes fail instead of ending
/// the program.
void survive_failing_writes();

}  // namespace vitrum::app
