#pragma once

#include <sqlite3.h>

namespace fitgauge::store::sqlite {

/// Lets the statements of a connection call `row_digest(value, …)`.
void add_row_digest(sqlite3* handle);

}  // namespace fitgauge::store::sqlite
