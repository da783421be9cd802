#pragma once

#include "cli/context.hpp"
#include "cli/json_object.hpp"
#include "nc/klartext/diagnostic.hpp"

namespace fitgauge::cli {

// `fitgauge nc …`: the control's disk and its programs. A path is written as on the control or
// with strokes: TNC:\nc_prog\8255.h is nc_prog/8255.h.

/// Severity of a finding by its code; none switches it off.
using Levels = std::map<std::string, std::optional<klartext::Severity>, std::less<>>;

/// `cycle.dialog_contradicts=error`: off, note, warning or error. @errors Usage
Outcome<Levels> read_levels(const std::vector<std::string>& written);
/// Sets severities; an error of the program stays an error, because the program does not run.
void apply_levels(const Levels& levels, std::vector<klartext::Diagnostic>& found);

struct FormatOptions {
  std::vector<std::string> files;
  bool in_place = false;  ///< writes the files; otherwise prints
  bool from_control = false;
};

/// `nc format FILE…`: formats a program as a control lists it; a file keeps its encoding and line
/// ends.
/// @errors LocalFile, ProgramFailed for an unreadable program.
Outcome<ExitCode> run_nc_format(const Context& context, const FormatOptions& options);

struct ConvertOptions {
  std::string file;
  std::string target;         ///< a file here
  bool from_control = false;  ///< `file` is on the service
  bool force = false;         ///< replace a file that is there
};

/// `nc convert A.i A.h` and `A.h A.i`: the program in the other dialect. @errors Usage for other
/// names, LocalFile, ProgramFailed for a program with errors or a block without a form there.
Outcome<ExitCode> run_nc_convert(const Context& context, const ConvertOptions& options);

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

/// `nc get PATH [FILE]`: asks before it replaces a file. @errors LocalFile without consent.
Outcome<ExitCode> run_nc_get(const Context& context, const GetOptions& options);

/// The messages of a run, on standard error.
void print_messages(const JsonValue& run);

struct RunOptions {
  std::string program;  ///< which of them runs
  std::vector<std::string> programs{};
  bool from_control = false;              ///< they are programs of the service
  std::string setup{};                    ///< the name of a stored one; here a file
  std::string setup_file{};               ///< or a file with a setup
  std::vector<std::string> parameters{};  ///< `Q1=25`, `QS1=H7`
  std::string on_stop{};
  std::string language{};
  std::string part_id{};
  std::string order{};
  bool block_skip = false;
  std::string files_to{};  ///< local: the folder for files of the run
  bool force = false;      ///< replace files that are there
};

/// `nc run PROGRAM…`: prints the screen; the exit code is the verdict of the last measuring cycle,
/// Good without one, ProgramFailed when the program did not complete.
Outcome<ExitCode> run_nc_run(const Context& context, const RunOptions& options);

/// Runs a local program on the setup of a file, with the programs and tool tables in its folder or
/// its folder `table`.
/// @returns the document of the run as the service writes it, with local paths.
/// @errors LocalFile, Usage, Refused for the setup, ProgramFailed for a program with errors, which
///   are printed.
Outcome<std::string> run_here(const Context& context, RunOptions options);

struct CheckOptions {
  std::vector<std::string> files;
  bool from_control = false;  ///< use files of the service
  std::string format{};       ///< text, json or sarif; text when empty, json with --json
  std::vector<std::string> levels{};
  RunOptions run{};  ///< with a setup_file the programs also run on it
};

/// `nc check FILE…`: checks local programs without a service, or programs of the service, and the
/// programs they call. Exit code 0: nothing or notes, 1: warnings, 2: errors. @errors LocalFile,
/// Refused for the setup, Usage for a malformed level or parameter.
Outcome<ExitCode> run_nc_check(const Context& context, const CheckOptions& options);

/// Returns the findings in a local program, and with a setup those of its run.
/// @errors as of run_here, but for a program with errors.
Outcome<std::vector<klartext::Diagnostic>> found_here(const RunOptions& options);

/// The body of a run. @errors Usage for a parameter that cannot be read, LocalFile for the setup.
Outcome<std::string> run_order(const RunOptions& options);

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

/// `nc lsp`: a language server (LSP 3.17) on standard input and output, for both dialects, without
/// a service: diagnostics, hover, completion, definition, rename, formatting and remedies. Single
/// thread; unreadable input returns an error of JSON-RPC. Good if it ends after `shutdown`. @errors
/// LocalFile if the input ends before, Usage for a malformed level.
/// @param levels as of `nc check`
Outcome<ExitCode> run_nc_lsp(const Context& context, const std::vector<std::string>& levels);

}  // namespace fitgauge::cli
