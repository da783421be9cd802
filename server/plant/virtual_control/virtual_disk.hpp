#pragma once

#include "nc/program/control_disk.hpp"
#include "plant/lsv2/link/payload.hpp"
#include "service/files/file_service.hpp"
#include "service/runs/run_service.hpp"

namespace fitgauge::virtual_control {

using control_link::ControlError;
using control_link::ControlResult;
using interpreter::ControlPath;

inline constexpr std::string_view kRoot = "TNC:\\";

inline std::string absolute(std::string_view text, std::string_view directory) {
  std::string path(text);
  std::ranges::replace(path, '/', '\\');
  if (path.find(':') != std::string::npos) return path;
  if (path.starts_with('\\')) return std::string(kRoot.substr(0, 4)) + path;
  return std::string(directory) + path;
}

/// A file as a client names it: absolute, or relative to its directory. `/` separates as `\` does.
/// @param directory ends with `\`
/// @errors BadFileName: another drive, a path out of `TNC:\`, no file name.
inline ControlResult<ControlPath> file_path(std::string_view text, std::string_view directory) {
  auto path = ControlPath::parse(absolute(text, directory));
  if (!path) return ControlError::BadFileName;
  return *std::move(path);
}

/// A directory with its last `\`; the disk decides if it exists. @errors BadFileName.
inline ControlResult<std::string> directory_path(std::string_view text,
                                                 std::string_view directory) {
  std::string path = absolute(text, directory);
  while (path.ends_with('\\')) path.pop_back();
  if (ascii_iequals(path, kRoot.substr(0, 4))) return std::string(kRoot);
  const auto parsed = ControlPath::parse(path);
  if (!parsed) return ControlError::BadFileName;
  return parsed->text() + "\\";
}

/// A text as it travels in a mode that sends lines: the byte at the end of a line is NUL.
inline std::string lines_on_the_wire(std::string_view bytes) {
  std::string wire;
  wire.reserve(bytes.size());
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    const bool is_crlf = bytes[i] == '\r' && i + 1 < bytes.size() && bytes[i + 1] == '\n';
    if (is_crlf) ++i;
    wire += bytes[i] == '\n' ? '\0' : bytes[i];
  }
  return wire;
}

/// A file or a directory as the control lists it.
struct DiskEntry {
  std::string name;
  bool is_directory = false;
  std::int64_t size = 0;
  Timestamp modified_at{};
};

/// The control's disk: the files of `/v1/files`, and over them the files of the newest run.
/// Directories are those of files, those of every control (`nc_prog`, `table`), and those that
/// clients have made, which exist until the service ends. Used by one thread, which waits for the
/// storage.
class VirtualDisk {
 public:
  VirtualDisk(app::FileService& files, app::RunService& runs) : files_(files), runs_(runs) {}

  bool has_directory(std::string_view directory) {
    if (is_every_controls(directory)) return true;
    const std::string key = ascii_lower(directory);
    const auto made = made_.lower_bound(key);
    if (made != made_.end() && made->first.starts_with(key)) return true;
    const auto below = files_below(directory);
    return below && !below->empty();
  }

  /// Lists entries by name, directories first. @errors NoDirectory.
  ControlResult<std::vector<DiskEntry>> list(std::string_view directory) {
    if (!has_directory(directory)) return ControlError::NoDirectory;
    const auto below = TRY(files_below(directory));
    std::map<std::string, DiskEntry> directories;
    const auto add_directory = [&](std::string_view path, Timestamp time) {
      const std::string_view rest = path.substr(directory.size());
      const std::string_view name = rest.substr(0, rest.find('\\'));
      if (name.empty() || name.size() == rest.size()) return;
      DiskEntry& entry = directories[ascii_lower(name)];
      if (entry.name.empty()) entry.name = name;
      entry.is_directory = true;
      entry.modified_at = std::max(entry.modified_at, time);
    };
    const std::string key = ascii_lower(directory);
    for (const std::string_view path : kEveryControls) {
      if (ascii_lower(path).starts_with(key)) add_directory(path, {});
    }
    for (const auto& [made, path] : made_) {
      if (made.starts_with(key)) add_directory(path, {});
    }
    for (const auto& [path, entry] : below) add_directory(entry.name, entry.modified_at);
    std::vector<DiskEntry> entries;
    for (auto& [name, entry] : directories) entries.push_back(std::move(entry));
    for (const auto& [path, entry] : below) {
      if (entry.name.find('\\', directory.size()) == std::string::npos) {
        entries.push_back(without_folder(entry));
      }
    }
    return entries;
  }

  /// @errors NoDirectory: its parent; FileExists; NoSpace.
  ControlResult<void> make_directory(std::string_view directory) {
    if (has_directory(directory)) return ControlError::FileExists;
    if (!has_directory(parent_of(directory))) return ControlError::NoDirectory;
    if (made_bytes_ + directory.size() > kMostMadeBytes) return ControlError::NoSpace;
    keep_directory(directory);
    return {};
  }

  /// @errors NoDirectory, DirectoryNotEmpty, InUse: one of every control.
  ControlResult<void> remove_directory(std::string_view directory) {
    if (is_every_controls(directory)) return ControlError::InUse;
    const auto entries = TRY(list(directory));
    if (!entries.empty()) return ControlError::DirectoryNotEmpty;
    // The directory above may have been there only for this one.
    if (!is_every_controls(parent_of(directory))) keep_directory(parent_of(directory));
    made_bytes_ -= made_.erase(ascii_lower(directory)) * directory.size();
    return {};
  }

  /// @errors NoFile.
  ControlResult<DiskEntry> find(const ControlPath& path) {
    const auto entries = TRY(files_below(path.text()));
    const auto found = entries.find(ascii_lower(path.text()));
    if (found == entries.end()) return ControlError::NoFile;
    return without_folder(found->second);
  }

  /// @errors NoFile.
  ControlResult<std::string> read(const ControlPath& path) {
    const auto written = run_files();
    if (const auto found = written.find(path.key()); found != written.end()) {
      return found->second.first->bytes;
    }
    auto file =
        TRY(wait_for<store::FileContent>([&](auto done) { files_.read(path, std::move(done)); }));
    return std::move(file.content);
  }

  /// Writes a new file or replaces one. @errors NoDirectory, NoSpace.
  ControlResult<void> write(const ControlPath& path, std::string_view bytes) {
    if (!has_directory(path.directory())) return ControlError::NoDirectory;
    TRY(wait_for<bool>(
        [&](auto done) { files_.write(path, bytes, std::nullopt, {}, std::move(done)); }));
    hide(path);
    return {};
  }

  /// @errors NoFile.
  ControlResult<void> remove(const ControlPath& path) {
    TRY(find(path));
    const auto removed = wait_for<bool>(
        [&](auto done) { files_.remove(path, std::nullopt, {}, {}, std::move(done)); });
    // A file that only the run has is not stored.
    if (!removed && removed.error() != ControlError::NoFile) return removed.error();
    hide(path);
    keep_directory(path.directory());
    return {};
  }

  /// Copies a file, or renames it. @errors NoFile, NoDirectory, FileExists, NoSpace.
  ControlResult<void> copy(const ControlPath& source, const ControlPath& target, bool moves) {
    const auto bytes = TRY(read(source));
    if (find(target)) return ControlError::FileExists;
    TRY(write(target, bytes));
    return moves ? remove(source) : ControlResult<void>();
  }

 private:
  /// Maximum wait for the files of a running program.
  static constexpr std::chrono::milliseconds kPatience{50};
  /// Maximum bytes of the names of directories that clients make.
  static constexpr std::size_t kMostMadeBytes = std::size_t{1} << 20;
  static constexpr std::string_view kEveryControls[] = {kRoot, "TNC:\\nc_prog\\", "TNC:\\table\\"};

  static bool is_every_controls(std::string_view directory) {
    return std::ranges::any_of(
        kEveryControls, [&](std::string_view each) { return ascii_iequals(each, directory); });
  }
  /// Returns the parent of a directory; the root is its own parent.
  static std::string_view parent_of(std::string_view directory) {
    directory.remove_suffix(1);
    const std::string_view parent = directory.substr(0, directory.rfind('\\') + 1);
    return parent.empty() ? kRoot : parent;
  }
  static DiskEntry without_folder(DiskEntry entry) {
    entry.name.erase(0, entry.name.rfind('\\') + 1);
    return entry;
  }

  /// Waits for a function that calls `done` on another thread.
  template <class T, class Begin>
  static ControlResult<T> wait_for(const Begin& begin) {
    auto result = wait_for_result<T>(begin);
    if (result) return *std::move(result);
    switch (result.error().code) {
      case ErrorCode::FileUnknown: return ControlError::NoFile;
      case ErrorCode::StorageBusy:
      case ErrorCode::StorageUnavailable: return ControlError::NoSpace;
      default: return ControlError::Failed;
    }
  }

  /// Files of the newest run that no client has replaced or removed.
  std::map<std::string, std::pair<const interpreter::WrittenFile*, Timestamp>> run_files() {
    std::map<std::string, std::pair<const interpreter::WrittenFile*, Timestamp>> found;
    const auto run = runs_.newest();
    if (run == nullptr) return found;
    if (run->id() != run_) hidden_.clear();
    run_ = run->id();
    newest_files_ = run->look(app::Look::StateAndFiles, kPatience).files;
    if (newest_files_ == nullptr) return found;
    for (const interpreter::WrittenFile& file : *newest_files_) {
      if (hidden_.contains(file.path.key())) continue;
      found.emplace(file.path.key(), std::pair(&file, run->created_at()));
    }
    return found;
  }

  /// Returns every file whose path begins with `prefix`, by key.
  ControlResult<std::map<std::string, DiskEntry>> files_below(std::string_view prefix) {
    const auto stored = TRY(wait_for<std::vector<store::FileEntry>>(
        [&](auto done) { files_.list(std::string(prefix), std::move(done)); }));
    std::map<std::string, DiskEntry> entries;
    for (const store::FileEntry& file : stored) {
      entries[ascii_lower(file.path)] = {
          .name = file.path, .size = file.size, .modified_at = file.modified_at};
    }
    const std::string below = ascii_lower(prefix);
    for (const auto& [key, written] : run_files()) {
      const auto& [file, time] = written;
      if (!ascii_lower(key).starts_with(below)) continue;
      entries[ascii_lower(key)] = {.name = file->path.text(),
                                   .size = static_cast<std::int64_t>(file->bytes.size()),
                                   .modified_at = time};
    }
    return entries;
  }

  void keep_directory(std::string_view directory) {
    if (made_bytes_ + directory.size() > kMostMadeBytes) return;
    if (made_.emplace(ascii_lower(directory), directory).second) made_bytes_ += directory.size();
  }
  /// Uses the stored file from now on, not the run's file.
  void hide(const ControlPath& path) {
    if (run_files().contains(path.key())) hidden_.insert(path.key());
  }

  app::FileService& files_;
  app::RunService& runs_;
  std::map<std::string, std::string> made_;  ///< by key: as spelled
  std::size_t made_bytes_ = 0;
  /// The files that run_files() points into.
  std::shared_ptr<const std::vector<interpreter::WrittenFile>> newest_files_;
  std::int64_t run_ = 0;  ///< the run whose files `hidden_` names
  std::set<std::string> hidden_;
};

}  // namespace fitgauge::virtual_control
