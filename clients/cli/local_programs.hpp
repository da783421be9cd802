#pragma once

#include <string>
#include <vector>

#include "cli/context.hpp"

namespace fitgauge::cli {

struct CheckOptions {
  std::vector<std::string> files;
  bool from_control = false;  ///< the files are those of the service
  std::string format{};       ///< text, json or sarif; text when empty, json with --json
  std::vector<std::string>
      levels{};  ///< `cycle.dialog_contradicts=error`: off, note, warning or error
};

/// `nc check FILE…`, of files here without a service: programs and what they call in their folder.
/// Exit code 0: nothing or notes, 1: warnings, 2: errors. @errors LocalFile, Usage for a level that
/// cannot be read.
Outcome<ExitCode> run_nc_check_local(const Context& context, const CheckOptions& options);

struct FormatOptions {
  std::vector<std::string> files;
  bool in_place = false;  ///< writes the files, else prints
  bool from_control = false;
};

/// `nc format FILE…`: as a control lists a program. @errors LocalFile, ProgramFailed for what
/// cannot be read.
Outcome<ExitCode> run_nc_format(const Context& context, const FormatOptions& options);

struct ConvertOptions {
  std::string file;
  std::string target;         ///< a file here
  bool from_control = false;  ///< `file` is one of the service
  bool force = false;         ///< replace a file that is there
};

/// `nc convert A.i A.h` and `A.h A.i`: the program in the other dialect. @errors Usage for other
/// names, LocalFile, ProgramFailed for a program with errors or a block without a form there.
Outcome<ExitCode> run_nc_convert(const Context& context, const ConvertOptions& options);

struct RunOptions;

/// Runs a program of this machine here, on the setup of a file, with what it calls in its folder
/// and the tool tables there or in its folder `table`.
/// @returns the document of the run as the service writes it, with places of this machine.
/// @errors LocalFile, Usage, Refused for the setup, ProgramFailed for a program with errors, which
///   are printed.
Outcome<std::string> run_here(const Context& context, RunOptions options);

}  // namespace fitgauge::cli
