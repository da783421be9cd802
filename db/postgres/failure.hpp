#pragma once

#include <postgresql/libpq-fe.h>

#include <string_view>

namespace fitgauge::store::postgres {

/// Throws for a statement that failed: StorageFailure when the server, the connection or a limit is
/// to blame, std::logic_error when the statement is.
[[noreturn]] void throw_failure(const PGconn* connection, const PGresult* result);

}  // namespace fitgauge::store::postgres
