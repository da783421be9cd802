#include "db/postgres/migrator.hpp"

#include <fmt/format.h>

#include "db/postgres/database.hpp"
#include "db/sql/statement.hpp"
#include "db/store/storage_failure.hpp"

namespace fitgauge::store::postgres {
namespace {

bool has_schema(Connection& connection) {
  sql::Statement find(connection, "SELECT count(*) FROM pg_namespace WHERE nspname = ?");
  return find.returning<std::int64_t>(std::string_view("fitgauge")) > 0;
}

/// @pre there is the schema
Result<std::size_t> taken_steps(Connection& connection) {
  const auto steps = sql::check_steps(connection, migrations());
  if (!steps) return steps.error();
  if (*steps > 0) return static_cast<std::size_t>(*steps);
  return Error{ErrorCode::DatabaseForeign,
               "the schema fitgauge of the database lists no migration"};
}

}  // namespace

Result<void> check_server(const std::string& address) {
  try {
    Connection connection(address);
    if (has_schema(connection)) {
      const auto steps = taken_steps(connection);
      return steps ? Result<void>() : steps.error();
    }
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

Result<void> prepare_schema(const std::string& address, bool may_change, std::int64_t now_ns) {
  Connection connection(address);
  // The number is nobody else's: the first eight letters of "fitgauge".
  connection.send("BEGIN");
  connection.send("SELECT pg_advisory_xact_lock(7379538914411767653)");
  connection.wait();
  std::size_t taken = 0;
  if (has_schema(connection)) {
    const auto steps = taken_steps(connection);
    if (!steps) return steps.error();
    taken = *steps;
  }
  const auto missing = migrations().subspan(taken);
  if (!missing.empty() && !may_change) {
    return Error{ErrorCode::StorageUnavailable,
                 taken == 0 ? "the database has no schema fitgauge: start the daemon on it first"
                            : "the database has an older schema: start the daemon on it once"};
  }
  for (const sql::Migration& migration : missing) {
    connection.run_script(std::string(migration.sql));
    sql::record_step(connection, migration, now_ns);
  }
  connection.send("COMMIT");
  connection.wait();
  return {};
}

}  // namespace fitgauge::store::postgres
