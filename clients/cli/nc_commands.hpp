#pragma once

#include <filesystem>

#include "cli/commands.hpp"
#include "nc/klartext/diagnostic.hpp"
#include "nc/program/control_disk.hpp"

namespace fitgauge::cli {

// `fitgauge nc …`: the control's disk and its programs. A path is written as on the control or
// with strokes: TNC:\nc_prog\8255.h is nc_prog/8255.h.

/// Severity of a finding by its code; none switches it off.
using Levels = std::map<std::string, std::optional<klartext::Severity>, std::less<>>;

/// `cycle.dialog_contradicts=error`: off, note, warning or error. @errors Usage
Outcome<Levels> read_levels(const std::vector<std::string>& written);
/// Sets severities; an error of the program stays an error, because the program does not run.
void apply_levels(const Levels& levels, std::vector<klartext::Diagnostic>& found);

/// Declares the option of read_levels().
void add_levels(CLI::App& command, std::vector<std::string>& levels);

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

/// Runs a local program on the setup of a file, with the programs and tool tables in its folder or
/// its folder `table`.
/// @returns the document of the run as the service writes it, with local paths.
/// @errors LocalFile, Usage, Refused for the setup, ProgramFailed for a program with errors, which
///   are printed.
Outcome<std::string> run_here(const Context& context, RunOptions options);

/// Returns the findings in a local program, and with a setup those of its run.
/// @errors as of run_here, but for a program with errors.
Outcome<std::vector<klartext::Diagnostic>> found_here(const RunOptions& options);

/// The body of a run. @errors Usage for a parameter that cannot be read, LocalFile for the setup.
Outcome<std::string> run_order(const RunOptions& options);

/// `nc_prog/8255` of `TNC:\nc_prog\8255`.
std::string relative_of(std::string_view path);

/// A file of a control below a folder of this machine. Case does not count on a control.
std::optional<std::filesystem::path> find_below(const std::filesystem::path& folder,
                                                std::string_view path);

/// The folder of a file as the disk of a control; each file is read when it is requested. Programs
/// find files in this folder, which is TNC:\. The folder's 82553_hole.tab and 82553_shaft.tab
/// replace the tables of ISO 286.
class FolderDisk final : public interpreter::ControlDisk {
 public:
  explicit FolderDisk(const std::string& file);

  std::optional<interpreter::ControlFile> find(const interpreter::ControlPath& path) const override;
  std::optional<std::string> revision(const interpreter::ControlPath& path) const override;
  bool has_directory(std::string_view directory) const override;

  /// Returns the name of a file on this machine; unchanged if the file does not exist.
  std::string name_here(const std::string& path) const;

 private:
  std::optional<std::filesystem::path> local(std::string_view path) const {
    return find_below(folder_, path);
  }

  std::filesystem::path folder_;
};

/// Returns the name of a file on its FolderDisk. @errors LocalFile: it cannot be read, or controls
/// do not allow the name.
Outcome<interpreter::ControlPath> local_program(const std::string& file);

}  // namespace fitgauge::cli
