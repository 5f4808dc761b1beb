#pragma once

namespace vitrum::app {

/// From now on SIGINT and SIGTERM are remembered instead of ending the program; a second SIGINT ends it at
/// once.
void catch_signals();
/// The signal caught, or 0.
int caught_signal();

}  // namespace vitrum::app
