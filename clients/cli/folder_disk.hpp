#pragma once

#include <filesystem>

#include "cli/outcome.hpp"
#include "nc/program/control_disk.hpp"

namespace fitgauge::cli {

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
