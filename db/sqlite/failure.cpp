#include "db/sqlite/failure.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "base/descriptor.hpp"
#include "db/sqlite/data_directory.hpp"
#include "db/store/storage_failure.hpp"

namespace fitgauge::store::sqlite {
namespace {

/// Whether a call to the system may have failed: only then errno says something.
bool is_of_the_system(int code) {
  const int primary = code & 0xFF;
  return primary == SQLITE_IOERR || primary == SQLITE_FULL || primary == SQLITE_CANTOPEN ||
         primary == SQLITE_READONLY || primary == SQLITE_PERM;
}

std::filesystem::path file_of(sqlite3* handle) {
  const char* const name = handle == nullptr ? nullptr : sqlite3_db_filename(handle, "main");
  return name == nullptr ? "" : name;
}

/// Why no file can be created beside this one: the errno.
std::optional<int> error_of_creating(const std::filesystem::path& file) {
  if (file.empty()) return std::nullopt;
  const Descriptor nameless(
      ::open(folder_of(file).c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600));
  return nameless.is_open() || errno == EOPNOTSUPP ? std::nullopt : std::optional(errno);
}

/// `storage: disk I/O error (SQLite code 778, errno 27: File too large)`
std::string describe(sqlite3* handle, int code, int system_error, std::string_view doing) {
  std::string text = fmt::format("{}: {}", doing, sqlite3_errstr(code));
  if (handle != nullptr) {
    const std::string_view message = sqlite3_errmsg(handle);
    if (message != sqlite3_errstr(code)) text += fmt::format(": {}", message);
  }
  text += fmt::format(" (SQLite code {}", code);
  if (is_of_the_system(code) && system_error != 0) {
    text += fmt::format(", errno {}: {}", system_error, std::strerror(system_error));
  }
  return text + ")";
}

}  // namespace

void throw_failure(sqlite3* handle, int code, std::string_view doing) {
  // SQLite loses the number where a commit fails, so the last call's own is taken.
  const int last_error = errno;
  const int kept = handle == nullptr ? 0 : sqlite3_system_errno(handle);
  int system_error = kept != 0 ? kept : last_error;
  // Where a file cannot be created, SQLite tries to open it to read, and keeps that error.
  if ((code & 0xFF) == SQLITE_CANTOPEN && system_error == ENOENT) {
    system_error = error_of_creating(file_of(handle)).value_or(system_error);
  }
  const std::string what = describe(handle, code, system_error, doing);
  switch (code & 0xFF) {
    case SQLITE_CORRUPT:
    case SQLITE_NOTADB: throw StorageFailure({ErrorCode::StorageCorrupt, what});
    case SQLITE_FULL:
    case SQLITE_IOERR:
    case SQLITE_READONLY:
    case SQLITE_CANTOPEN:
    case SQLITE_PERM:
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
    case SQLITE_PROTOCOL:
    case SQLITE_NOMEM:
    case SQLITE_INTERRUPT: throw StorageFailure({ErrorCode::StorageUnavailable, what});
    default: throw std::logic_error(what);
  }
}

}  // namespace fitgauge::store::sqlite
