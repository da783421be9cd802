#include "postgres/migrator.hpp"

#include <fmt/format.h>

#include "base/digest.hpp"
#include "postgres/database.hpp"
#include "sql/statement.hpp"
#include "store/storage_failure.hpp"

namespace fitgauge::store::postgres {
namespace {

constexpr std::string_view kName = "0001_service";

Error foreign(std::string message) { return {ErrorCode::DatabaseForeign, std::move(message)}; }

Result<void> check(Connection& connection) {
  sql::Statement applied(connection,
                         "SELECT number, checksum FROM schema_migrations ORDER BY number");
  sql::Rows rows = applied.query();
  if (!rows.next()) return foreign("the schema fitgauge of the database lists no migration");
  if (rows.get<Digest>(1) != sha256(schema())) {
    return foreign(
        "the schema fitgauge of the database is not the one of this build; use the build "
        "that made it");
  }
  if (!rows.next()) return {};
  return Error{ErrorCode::DatabaseNewer,
               fmt::format("the database has schema {}, this version of fitgauge knows 1; use the "
                           "newer version",
                           rows.get<std::int64_t>(0))};
}

bool has_schema(Connection& connection) {
  sql::Statement find(connection, "SELECT count(*) FROM pg_namespace WHERE nspname = ?");
  return find.returning<std::int64_t>(std::string_view("fitgauge")) > 0;
}

}  // namespace

Result<void> check_server(const std::string& address) {
  try {
    Connection connection(address);
    if (has_schema(connection)) return check(connection);
    sql::Statement may(connection,
                       "SELECT has_database_privilege(current_database(), 'CREATE')::int::int8");
    if (may.returning<std::int64_t>() == 1) return {};
    return Error{ErrorCode::StorageUnavailable,
                 "the database has no schema fitgauge, and this user may not make it: GRANT CREATE "
                 "ON DATABASE, or let one who may start a daemon once"};
  } catch (const StorageFailure& failure) {
    return failure.error();
  }
}

Result<void> prepare_schema(const std::string& address, bool may_create, std::int64_t now_ns) {
  Connection connection(address);
  // The number is nobody else's: the first eight letters of "fitgauge".
  connection.send("BEGIN");
  connection.send("SELECT pg_advisory_xact_lock(7379538914411767653)");
  connection.wait();
  const bool is_there = has_schema(connection);
  if (!is_there && !may_create) {
    return Error{ErrorCode::StorageUnavailable,
                 "the database has no schema fitgauge: start the daemon on it first"};
  }
  if (!is_there) {
    connection.run_script(std::string(schema()));
    sql::Statement record(connection, "INSERT INTO schema_migrations VALUES (?, ?, ?, ?)");
    record.run(1, kName, sha256(schema()), now_ns);
  } else if (const auto checked = check(connection); !checked) {
    return checked;
  }
  connection.send("COMMIT");
  connection.wait();
  return {};
}

}  // namespace fitgauge::store::postgres
