#pragma once

namespace fitgauge::daemon {

/// fitgauged: reads flags, environment and file, then serves or runs a command.
/// @returns the exit code: 0, 1 when the service cannot run or a check found something, 2 when the
///   command line or the configuration is wrong. One line on stderr says why.
int run_command_line(int argc, char** argv);

}  // namespace fitgauge::daemon
