#pragma once

#include <sqlite3.h>

#include <string_view>

#include "base/error.hpp"

namespace fitgauge::store::sqlite {

/// Throws for a result code that is not SQLITE_OK: StorageFailure when the disk or the file is to
/// blame, std::logic_error when the statement is.
[[noreturn]] void throw_failure(sqlite3* handle, int code, std::string_view doing);

inline void require_ok(sqlite3* handle, int code, std::string_view doing) {
  if (code != SQLITE_OK) throw_failure(handle, code, doing);
}

}  // namespace fitgauge::store::sqlite
