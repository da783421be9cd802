#include "sqlite/failure.hpp"

#include <fmt/format.h>

#include <cstring>
#include <stdexcept>

#include "store/storage_failure.hpp"

namespace fitgauge::store::sqlite {
namespace {

std::string describe(sqlite3* handle, int code, std::string_view doing) {
  std::string text = fmt::format("{}: {}", doing, sqlite3_errstr(code));
  if (handle == nullptr) return text;
  if (const std::string_view message = sqlite3_errmsg(handle); message != sqlite3_errstr(code)) {
    text += fmt::format(" ({})", message);
  }
  if (const int number = sqlite3_system_errno(handle); number != 0) {
    text += fmt::format(" [{}]", std::strerror(number));
  }
  return text;
}

}  // namespace

void throw_failure(sqlite3* handle, int code, std::string_view doing) {
  const std::string what = describe(handle, code, doing);
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
