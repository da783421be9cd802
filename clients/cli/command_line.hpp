#pragma once

namespace fitgauge::cli {

/// Runs `fitgauge`. @returns the exit code, an ExitCode.
int run_command_line(int argc, char** argv);

}  // namespace fitgauge::cli
