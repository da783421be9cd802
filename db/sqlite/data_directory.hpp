#pragma once

#include <filesystem>

#include "base/result.hpp"

namespace fitgauge::store {

/// The lock that keeps a second daemon out of a data directory; released when destroyed, also by a
/// kill.
class DirectoryLock {
 public:
  /// Creates the directory where there is none.
  /// @errors DatabaseInUse; StorageUnavailable when the directory cannot be made or written.
  static Result<DirectoryLock> acquire(const std::filesystem::path& directory);

  DirectoryLock(DirectoryLock&& other) noexcept;
  DirectoryLock& operator=(DirectoryLock&&) = delete;
  ~DirectoryLock();

 private:
  explicit DirectoryLock(int descriptor) : descriptor_(descriptor) {}

  int descriptor_;
};

/// Looks at the first bytes of an existing database without opening it as one: SQLite would take an
/// empty file for a new database. Called before any connection to the file is open (closing a
/// descriptor releases the locks SQLite holds).
/// @errors DatabaseForeign; StorageUnavailable when it cannot be read and written.
Result<void> inspect_file(const std::filesystem::path& file);

/// Creates an empty file where there is none: the name is taken before the content is made.
/// @errors StorageUnavailable, also when it exists.
Result<void> reserve_name(const std::filesystem::path& file);

/// Makes the file and its directory entry durable.
/// @errors StorageUnavailable
Result<void> sync_file(const std::filesystem::path& file);

}  // namespace fitgauge::store
