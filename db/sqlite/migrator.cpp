#include "sqlite/migrator.hpp"

#include <fmt/format.h>

#include <string>

#include "sql/statement.hpp"

namespace fitgauge::store::sqlite {

int schema_version(Connection& connection) {
  return static_cast<int>(connection.query_integer("PRAGMA user_version"));
}

Result<void> check_history(Connection& connection, std::span<const Migration> known) {
  const int version = schema_version(connection);
  if (version > static_cast<int>(known.size())) {
    return Error{ErrorCode::DatabaseNewer,
                 fmt::format("the database has schema {}, this version of fitgauge knows {}; use "
                             "the newer version, or restore the backup made before its upgrade",
                             version, known.size())};
  }
  sql::Statement applied(connection,
                         "SELECT number, checksum FROM schema_migrations ORDER BY number");
  sql::Rows rows = applied.query();
  int count = 0;
  for (; rows.next(); ++count) {
    const auto number = rows.get<int>(0);
    if (count == version || number != known[static_cast<std::size_t>(count)].number ||
        rows.get<Digest>(1) != sha256(known[static_cast<std::size_t>(count)].sql)) {
      return Error{ErrorCode::DatabaseForeign,
                   fmt::format("migration {} of the database is not the one of this build; use "
                               "the build that made the database",
                               number)};
    }
  }
  if (count != version) {
    return Error{
        ErrorCode::DatabaseForeign,
        fmt::format("the database claims schema {} but lists {} migrations", version, count)};
  }
  return {};
}

void migrate(Connection& connection, std::span<const Migration> known, std::int64_t now_ns) {
  connection.execute("BEGIN IMMEDIATE");
  sql::Statement record(connection, "INSERT INTO schema_migrations VALUES (?, ?, ?, ?)");
  for (const Migration& migration :
       known.subspan(static_cast<std::size_t>(schema_version(connection)))) {
    connection.execute(std::string(migration.sql));
    record.run(migration.number, migration.name, sha256(migration.sql), now_ns);
  }
  connection.execute(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}; COMMIT",
                                 kApplicationId, known.size()));
}

}  // namespace fitgauge::store::sqlite
