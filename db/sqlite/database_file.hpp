#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

#include "base/result.hpp"
#include "db/sql/sealed_table.hpp"
#include "db/sqlite/connection.hpp"
#include "db/store/open_options.hpp"

namespace fitgauge::store::sqlite {

/// `FtGg` in the header of the file: whose database it is.
inline constexpr std::int32_t kApplicationId = 0x46744767;

using sql::Migration;

/// The number of the last step applied, which is SQLite's user_version.
int schema_version(Connection& connection);

/// Compares the steps a database has gone through with `known`.
/// @errors DatabaseNewer when it has more; DatabaseForeign when a step's text was another.
Result<void> check_history(Connection& connection, std::span<const Migration> known);

/// Applies the missing steps in one transaction.
void migrate(Connection& connection, std::span<const Migration> known, std::int64_t now_ns);

}  // namespace fitgauge::store::sqlite

namespace fitgauge::store {

/// Makes `fitgauge.db` of the options' directory ready for use with the schema `known`: creates it
/// or checks it, and upgrades it after a backup (`fitgauge.db.schema-N.backup`).
/// With Access::Attach it must be there and have just this schema.
/// @errors as open_database(), except DatabaseInUse.
Result<void> prepare_file(const OpenOptions& options, std::span<const sqlite::Migration> known,
                          std::int64_t now_ns);

/// Copies the live database into a new file, durable when it returns.
/// @errors StorageUnavailable, also when `target` exists.
Result<void> copy_database(const std::filesystem::path& source,
                           const std::filesystem::path& target);

}  // namespace fitgauge::store
