#pragma once

#include "cli/context.hpp"

namespace fitgauge::cli {

// `fitgauge control …`: a HEIDENHAIN control over LSV-2. Each command names the control, HOST or
// HOST:PORT, and logs in with the least rights it needs. No other command sends to a control.

/// `control ls ADDRESS [DIRECTORY]`
Outcome<ExitCode> run_control_ls(const Context& context, const std::string& address,
                                 const std::string& directory);

struct ControlGetOptions {
  std::string address;
  std::string path;
  std::string file{};  ///< its name here when empty; `-` is standard output
  bool force = false;  ///< replace a file that is there
};

/// `control get ADDRESS PATH [FILE]`: bytes as they are on the control.
Outcome<ExitCode> run_control_get(const Context& context, const ControlGetOptions& options);

struct ControlPutOptions {
  std::vector<std::string> words;  ///< ADDRESS FILE… DESTINATION
  bool force = false;              ///< replace a file that is on the control
};

/// `control put`: programs and tables as lines, other files as bytes.
/// @errors Refused if the control has a file of that name and `force` is not set.
Outcome<ExitCode> run_control_put(const Context& context, const ControlPutOptions& options);

/// `control run ADDRESS PROGRAM`: starts a program of a virtual control and waits for its end.
/// @errors Refused at a real control: LSV-2 has no NC start. ProgramFailed.
Outcome<ExitCode> run_control_run(const Context& context, const std::string& address,
                                  const std::string& program);

/// `control state ADDRESS`
Outcome<ExitCode> run_control_state(const Context& context, const std::string& address);

}  // namespace fitgauge::cli
