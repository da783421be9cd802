#include "db/sql/migration.hpp"

#include <fmt/format.h>

#include "db/sql/statement.hpp"

namespace fitgauge::store::sql {

Error newer_database(std::int64_t found, std::size_t known) {
  return {
      ErrorCode::DatabaseNewer,
      fmt::format("the database has schema {}, this version of fitgauge knows {}; use the newer "
                  "version, or restore the backup made before its upgrade",
                  found, known)};
}

Result<int> check_steps(Connection& connection, std::span<const Migration> known) {
  Statement taken(connection, "SELECT number, checksum FROM schema_migrations ORDER BY number");
  Rows rows = taken.query();
  std::size_t count = 0;
  for (; rows.next(); ++count) {
    const auto number = rows.get<int>(0);
    if (count == known.size()) return newer_database(number, known.size());
    if (number != known[count].number || rows.get<Digest>(1) != sha256(known[count].sql)) {
      return Error{ErrorCode::DatabaseForeign,
                   fmt::format("migration {} of the database is not the one of this build; use "
                               "the build that made the database",
                               number)};
    }
  }
  return static_cast<int>(count);
}

void record_step(Connection& connection, const Migration& step, std::int64_t now_ns) {
  Statement record(connection, "INSERT INTO schema_migrations VALUES (?, ?, ?, ?)");
  record.run(step.number, step.name, sha256(step.sql), now_ns);
}

}  // namespace fitgauge::store::sql
