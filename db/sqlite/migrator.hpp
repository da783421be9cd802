#pragma once

#include <cstdint>
#include <span>
#include <string_view>

#include "base/result.hpp"
#include "sqlite/connection.hpp"

namespace fitgauge::store::sqlite {

/// `FtGg` in the header of the file: whose database it is.
inline constexpr std::int32_t kApplicationId = 0x46744767;

/// One step of the schema. Steps are numbered from 1 without a gap and only go forward.
struct Migration {
  int number = 0;
  std::string_view name;
  std::string_view sql;
};

/// The steps this build knows, from db/migrations.
std::span<const Migration> migrations();

/// The number of the last step applied, which is SQLite's user_version.
int schema_version(Connection& connection);

/// Compares the steps a database has gone through with `known`.
/// @errors DatabaseNewer when it has more; DatabaseForeign when a step's text was another.
Result<void> check_history(Connection& connection, std::span<const Migration> known);

/// Applies the missing steps in one transaction.
void migrate(Connection& connection, std::span<const Migration> known, std::int64_t now_ns);

}  // namespace fitgauge::store::sqlite
