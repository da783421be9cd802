#include "db/sqlite/migrator.hpp"

#include <fmt/format.h>

#include <string>

namespace fitgauge::store::sqlite {

int schema_version(Connection& connection) {
  return static_cast<int>(connection.query_integer("PRAGMA user_version"));
}

Result<void> check_history(Connection& connection, std::span<const Migration> known) {
  const int version = schema_version(connection);
  if (version > static_cast<int>(known.size())) return sql::newer_database(version, known.size());
  const Result<int> steps =
      sql::check_steps(connection, known.first(static_cast<std::size_t>(version)));
  if (!steps && steps.error().code != ErrorCode::DatabaseNewer) return steps.error();
  if (!steps || *steps != version) {
    return Error{ErrorCode::DatabaseForeign,
                 fmt::format("the database claims schema {} but lists {} migrations", version,
                             steps ? fmt::format("{}", *steps) : "more")};
  }
  return {};
}

void migrate(Connection& connection, std::span<const Migration> known, std::int64_t now_ns) {
  connection.execute("BEGIN IMMEDIATE");
  for (const Migration& migration :
       known.subspan(static_cast<std::size_t>(schema_version(connection)))) {
    connection.execute(std::string(migration.sql));
    sql::record_step(connection, migration, now_ns);
  }
  connection.execute(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}; COMMIT",
                                 kApplicationId, known.size()));
}

}  // namespace fitgauge::store::sqlite
