#pragma once

#include <cstdint>
#include <span>

#include "base/result.hpp"
#include "db/sql/migration.hpp"
#include "db/sqlite/connection.hpp"

namespace fitgauge::store::sqlite {

/// `FtGg` in the header of the file: whose database it is.
inline constexpr std::int32_t kApplicationId = 0x46744767;

using sql::Migration;

/// The steps this build knows, from db/migrations/sqlite.
std::span<const Migration> migrations();

/// The number of the last step applied, which is SQLite's user_version.
int schema_version(Connection& connection);

/// Compares the steps a database has gone through with `known`.
/// @errors DatabaseNewer when it has more; DatabaseForeign when a step's text was another.
Result<void> check_history(Connection& connection, std::span<const Migration> known);

/// Applies the missing steps in one transaction.
void migrate(Connection& connection, std::span<const Migration> known, std::int64_t now_ns);

}  // namespace fitgauge::store::sqlite
