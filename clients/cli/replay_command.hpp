#pragma once

#include <string>

#include "cli/context.hpp"
#include "cli/nc_commands.hpp"

namespace fitgauge::cli {

struct ReplayOptions {
  RunOptions run{};
  std::string log{};       ///< of the control, as a file
  std::string contacts{};  ///< JSON: [[X, Y, Z], null, …]
};

/// `replay PROGRAM LOG --contacts FILE`: runs the program on a machine whose probe finds the
/// contacts of the file, and compares the logs it writes with LOG, by the digits LOG prints.
/// Prints every result that differs. @errors LocalFile, Refused; ProgramFailed: the program did not
/// complete, or a result differs or is missing.
Outcome<ExitCode> run_replay(const Context& context, const ReplayOptions& options);

}  // namespace fitgauge::cli
