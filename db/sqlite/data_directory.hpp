#pragma once

#include <sqlite3.h>
#include <sys/types.h>

#include <filesystem>

#include "base/folder.hpp"
#include "db/store/database.hpp"

namespace fitgauge::store::sqlite {

/// Throws for a result code other than SQLITE_OK: StorageFailure for faults of the disk or the
/// file, std::logic_error for faults of the statement.
[[noreturn]] void throw_failure(sqlite3* handle, int code, std::string_view doing);

inline void require_ok(sqlite3* handle, int code, std::string_view doing) {
  if (code != SQLITE_OK) throw_failure(handle, code, doing);
}

}  // namespace fitgauge::store::sqlite

namespace fitgauge::store {

/// `.` for a name without a folder.
std::filesystem::path folder_of(const std::filesystem::path& file);

inline std::filesystem::path with_suffix(std::filesystem::path file, std::string_view suffix) {
  return file += suffix;
}

/// Identifies the file that a path named when it was opened.
class FileIdentity {
 public:
  /// @errors StorageUnavailable
  static Result<FileIdentity> of(const std::filesystem::path& file);
  FileIdentity(std::filesystem::path path, dev_t device, ino_t inode)
      : path_(std::move(path)), device_(device), inode_(inode) {}

  /// Whether the path names the same file. @errors StorageUnavailable: it was removed or replaced.
  Result<void> check() const;

 private:
  std::filesystem::path path_;
  dev_t device_;
  ino_t inode_;
};

/// SQLite's write-ahead log and its index, next to the database while a connection is open.
/// Thread-safe.
class LogFiles {
 public:
  explicit LogFiles(std::filesystem::path database) : database_(std::move(database)) {}

  void remember();  ///< the files that a connection has opened
  void forget();    ///< before a connection closes that may remove them
  /// Whether they are the remembered files. @errors as FileIdentity::check().
  Result<void> check() const;
  /// Whether nothing that the log held is at its path.
  bool is_log_gone() const;

 private:
  const std::filesystem::path database_;
  mutable std::mutex mutex_;
  std::vector<FileIdentity> files_;
};

/// The lock that keeps a second daemon out of a data directory; released when destroyed, also by a
/// kill.
class DirectoryLock {
 public:
  /// Creates the directory if it does not exist.
  /// @errors DatabaseInUse; StorageUnavailable if the directory cannot be created or written.
  static Result<DirectoryLock> acquire(const std::filesystem::path& directory);

  /// Whether the folder still has the file that is locked. @errors as FileIdentity::check().
  Result<void> check() const { return file_.check(); }

 private:
  DirectoryLock(Descriptor descriptor, FileIdentity file)
      : descriptor_(std::move(descriptor)), file_(std::move(file)) {}

  Descriptor descriptor_;
  FileIdentity file_;
};

/// Whether the database and SQLite's files next to it are regular files, as far as they exist:
/// SQLite waits for the writer of a FIFO. @errors StorageUnavailable
Result<void> check_kinds(const std::filesystem::path& database);

/// Reads the first bytes of an existing database without opening it with SQLite, which would use an
/// empty file as a new database. Called before any connection to the file is open (closing a
/// descriptor releases the locks of SQLite).
/// @errors DatabaseForeign; StorageUnavailable if it cannot be read, or not written by a service.
Result<void> inspect_file(const std::filesystem::path& file, Access access);

/// Restricts a file and SQLite's files next to it to owner and group, because an older version made
/// them with the umask. A file of another owner does not change.
void close_to_others(const std::filesystem::path& database);

/// Creates an empty file that its owner writes and its group reads (0640 less the umask). SQLite
/// gives a database's log and its index the same rights.
/// @errors StorageUnavailable, also when it exists.
Result<void> reserve_name(const std::filesystem::path& file);

/// Renames a file to an unused name. @errors StorageUnavailable, also if the name exists.
Result<void> rename_to_new(const std::filesystem::path& from, const std::filesystem::path& to);

/// Makes the file and its directory entry durable.
/// @errors StorageUnavailable
Result<void> sync_file(const std::filesystem::path& file);

}  // namespace fitgauge::store
