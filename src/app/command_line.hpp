#pragma once

namespace vitrum::app {

/// Exit statuses of the program. exit_differ: `compare` has found more than the tolerance.
inline constexpr int exit_done = 0, exit_differ = 1, exit_input = 2, exit_computation = 3, exit_file = 4;

/// The whole program: parses the arguments, runs the command, turns errors into messages on standard error
/// and an exit status.
int command_line(int argc, char** argv);

}  // namespace vitrum::app
