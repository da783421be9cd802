#pragma once

#include <sqlite3.h>
#include <sys/types.h>

#include <filesystem>
#include <string_view>
#include <utility>

#include "base/folder.hpp"
#include "base/result.hpp"
#include "db/store/open_options.hpp"

namespace fitgauge::store::sqlite {

/// Throws for a result code that is not SQLITE_OK: StorageFailure when the disk or the file is to
/// blame, std::logic_error when the statement is.
[[noreturn]] void throw_failure(sqlite3* handle, int code, std::string_view doing);

inline void require_ok(sqlite3* handle, int code, std::string_view doing) {
  if (code != SQLITE_OK) throw_failure(handle, code, doing);
}

}  // namespace fitgauge::store::sqlite

namespace fitgauge::store {

/// `.` for a name alone.
std::filesystem::path folder_of(const std::filesystem::path& file);

/// Which file a path named when it was opened.
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

/// The lock that keeps a second daemon out of a data directory; released when destroyed, also by a
/// kill.
class DirectoryLock {
 public:
  /// Creates the directory where there is none.
  /// @errors DatabaseInUse; StorageUnavailable when the directory cannot be made or written.
  static Result<DirectoryLock> acquire(const std::filesystem::path& directory);

  /// Whether the folder still has the file that is locked. @errors as FileIdentity::check().
  Result<void> check() const { return file_.check(); }

 private:
  DirectoryLock(Descriptor descriptor, FileIdentity file)
      : descriptor_(std::move(descriptor)), file_(std::move(file)) {}

  Descriptor descriptor_;
  FileIdentity file_;
};

/// Looks at the first bytes of an existing database without opening it as one: SQLite would take an
/// empty file for a new database. Called before any connection to the file is open (closing a
/// descriptor releases the locks SQLite holds).
/// @errors DatabaseForeign; StorageUnavailable when it cannot be read, nor written by who serves.
Result<void> inspect_file(const std::filesystem::path& file, Access access);

/// Takes a file and what SQLite keeps beside it from everybody but its owner and group: an older
/// version made them with the umask alone. One that is another's stays as it is.
void close_to_others(const std::filesystem::path& database);

/// Creates an empty file that its owner writes and its group reads (0640 less the umask). SQLite
/// gives a database's log and its index the same rights.
/// @errors StorageUnavailable, also when it exists.
Result<void> reserve_name(const std::filesystem::path& file);

/// Renames a file to a name that is free. @errors StorageUnavailable, also when it is taken.
Result<void> rename_to_new(const std::filesystem::path& from, const std::filesystem::path& to);

/// Makes the file and its directory entry durable.
/// @errors StorageUnavailable
Result<void> sync_file(const std::filesystem::path& file);

}  // namespace fitgauge::store
