#include "db/sqlite/failure.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <stdexcept>

#include "db/store/storage_failure.hpp"

namespace fitgauge::store::sqlite {
namespace {

/// Whether a call to the system may have failed: only then errno says something.
bool is_of_the_system(int code) {
  const int primary = code & 0xFF;
  return primary == SQLITE_IOERR || primary == SQLITE_FULL || primary == SQLITE_CANTOPEN ||
         primary == SQLITE_READONLY || primary == SQLITE_PERM;
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
  const std::string what = describe(handle, code, kept != 0 ? kept : last_error, doing);
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
