#pragma once

#include <string>
#include <vector>

#include "cli/context.hpp"
#include "cli/json_object.hpp"
#include "cli/local_programs.hpp"

namespace fitgauge::cli {

// `fitgauge nc …`: the control's disk and its programs. A path is written as on the control or
// with strokes: TNC:\nc_prog\8255.h is nc_prog/8255.h.

/// `nc ls [PREFIX]`
Outcome<ExitCode> run_nc_ls(const Context& context, const std::string& prefix);

/// `nc put FILE… DESTINATION`: a destination that ends with a stroke is a folder, which several
/// files need.
Outcome<ExitCode> run_nc_put(const Context& context, const std::vector<std::string>& files,
                             const std::string& destination);

struct GetOptions {
  std::string path;
  std::string file{};  ///< its name here when empty; `-` is standard output
  bool force = false;  ///< replace a file that is there
};

/// `nc get PATH [FILE]`: asks before it replaces a file. @errors LocalFile when nobody says yes.
Outcome<ExitCode> run_nc_get(const Context& context, const GetOptions& options);

/// The messages of a run, on standard error.
void print_messages(const JsonValue& run);

/// `nc check --from-control PATH…` of the service's files, else run_nc_check_local. Exit code 0:
/// nothing or notes, 1: warnings, 2: errors.
Outcome<ExitCode> run_nc_check(const Context& context, const CheckOptions& options);

struct RunOptions {
  std::string program;  ///< which of them runs
  std::vector<std::string> programs{};
  bool from_control = false;              ///< they are programs of the service
  std::string setup{};                    ///< the name of a stored one; here a file
  std::string setup_file{};               ///< or a file that holds one
  std::vector<std::string> parameters{};  ///< `Q1=25`, `QS1=H7`
  std::string on_stop{};
  std::string language{};
  std::string part_id{};
  std::string order{};
  bool block_skip = false;
  std::string files_to{};  ///< here: the folder that gets what the run writes
  bool force = false;      ///< replace files that are there
};

/// `nc run PROGRAM…`: prints the screen; the exit code is the verdict of the last measuring cycle,
/// Good without one, ProgramFailed when the program did not complete.
Outcome<ExitCode> run_nc_run(const Context& context, const RunOptions& options);

/// The body of a run. @errors Usage for a parameter that cannot be read, LocalFile for the setup.
Outcome<std::string> run_order(const RunOptions& options);

}  // namespace fitgauge::cli
