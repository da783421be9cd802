#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "nc/program/control_disk.hpp"
#include "plant/lsv2/link/payload.hpp"
#include "service/files/file_service.hpp"
#include "service/runs/run_service.hpp"

namespace fitgauge::virtual_control {

inline constexpr std::string_view kRoot = "TNC:\\";

/// A file as a client names it: absolute, or relative to its directory. `/` separates as `\` does.
/// @param directory ends with `\`
/// @errors BadFileName: another drive, a path out of `TNC:\`, no file name.
control_link::ControlResult<interpreter::ControlPath> file_path(std::string_view text,
                                                                std::string_view directory);

/// A directory, with its last `\`; whether it is there is the disk's to say. @errors BadFileName.
control_link::ControlResult<std::string> directory_path(std::string_view text,
                                                        std::string_view directory);

/// The directory that a directory lies in; of the root the root.
std::string_view parent_of(std::string_view directory);

/// A file or a directory as the control lists it.
struct DiskEntry {
  std::string name;
  bool is_directory = false;
  std::int64_t size = 0;
  Timestamp modified_at{};
};

/// The control's disk: the files of `/v1/files`, and over them what the newest run has written so
/// far. Directories are those that files lie in, those of every control (`nc_prog`, `table`), and
/// those that clients have made, which last as long as the service runs. For one thread, which
/// waits for the storage.
class VirtualDisk {
 public:
  using Path = interpreter::ControlPath;
  template <class T>
  using Answer = control_link::ControlResult<T>;

  VirtualDisk(app::FileService& files, app::RunService& runs) : files_(files), runs_(runs) {}

  bool has_directory(std::string_view directory);
  /// By name, directories first. @errors NoDirectory.
  Answer<std::vector<DiskEntry>> list(std::string_view directory);
  /// @errors NoDirectory: its parent; FileExists; NoSpace.
  Answer<void> make_directory(std::string_view directory);
  /// @errors NoDirectory, DirectoryNotEmpty, InUse: one of every control.
  Answer<void> remove_directory(std::string_view directory);

  /// @errors NoFile.
  Answer<DiskEntry> find(const Path& path);
  /// @errors NoFile.
  Answer<std::shared_ptr<const std::string>> read(const Path& path);
  /// New or in the place of another. @errors NoDirectory, NoSpace.
  Answer<void> write(const Path& path, std::string_view bytes);
  /// @errors NoFile.
  Answer<void> remove(const Path& path);
  /// @errors NoFile, NoDirectory, FileExists, NoSpace.
  Answer<void> copy(const Path& source, const Path& target);
  /// @errors as copy.
  Answer<void> rename(const Path& source, const Path& target);

 private:
  using RunFiles = std::shared_ptr<const std::vector<interpreter::WrittenFile>>;
  /// What the newest run has written and no client has replaced or removed since.
  std::map<std::string, std::pair<const interpreter::WrittenFile*, Timestamp>> run_files();
  /// Every file whose path begins so, by key.
  Answer<std::map<std::string, DiskEntry>> files_below(std::string_view prefix);
  void keep_directory(std::string_view directory);
  void hide(const Path& path);

  app::FileService& files_;
  app::RunService& runs_;
  std::map<std::string, std::string> made_;  ///< by key: as spelled
  std::size_t made_bytes_ = 0;
  RunFiles newest_files_;  ///< that run_files points into
  std::int64_t run_ = 0;   ///< whose files `hidden_` names
  std::set<std::string> hidden_;
};

}  // namespace fitgauge::virtual_control
