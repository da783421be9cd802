#include "db/sql/sealed_table.hpp"

#include "db/store/stores.hpp"

namespace fitgauge::store::sql {

Error newer_database(std::int64_t found, std::size_t known) {
  return {ErrorCode::DatabaseNewer,
          fmt::format("the database has schema {}, and this version of fitgauge knows {}: use the "
                      "newer version, or restore the backup from before the upgrade",
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
                   fmt::format("migration {} of the database differs from this build: use the "
                               "build that made the database",
                               number)};
    }
  }
  return static_cast<int>(count);
}

void refuse_code(std::int64_t stored) {
  throw StorageFailure(
      {ErrorCode::StorageCorrupt, fmt::format("the database contains the unknown code {}: find the "
                                              "row with `fitgauged verify`, and restore a backup",
                                              stored)});
}

void record_step(Connection& connection, const Migration& step, std::int64_t now_ns) {
  Statement record(connection, "INSERT INTO schema_migrations VALUES (?, ?, ?, ?)");
  record.run(step.number, step.name, sha256(step.sql), now_ns);
}

}  // namespace fitgauge::store::sql

namespace fitgauge::store {
namespace {

constexpr std::array kTables = {
    kTableSets,     kTableRevisions, kApiKeys,          kIdempotentAnswers,
    kFileRevisions, kDocuments,      kChanges,          kRuns,
    kRunTraces,     kRunFiles,       kEvents,           kLog,
    kLogKeys,       kLogBranches,    kLogMarks,         kOrigins,
    kOriginKeys,    kOriginBases,    kOriginForks,      kOriginRevisions,
    kForwarding,    kReceived,       kTableRevisionIds, kNotes,
    kNoteOrigins};

std::string insert_into(const SealedTable& table, std::string_view verb, bool is_sealed) {
  std::string values = "?1";
  for (std::size_t i = 2; i <= split(table.columns, ',').size(); ++i) {
    values += fmt::format(", ?{}", i);
  }
  return is_sealed
             ? fmt::format("{} INTO {} ({}, seal) VALUES ({}, row_digest({}))", verb, table.name,
                           table.columns, values, values)
             : fmt::format("{} INTO {} ({}) VALUES ({})", verb, table.name, table.columns, values);
}

}  // namespace

std::string SealedTable::insert(const sql::Connection& connection) const {
  return insert_into(*this, "INSERT", connection.dialect().has_seals);
}

std::string SealedTable::replace(const sql::Connection& connection) const {
  if (connection.dialect().has_seals) return insert_into(*this, "INSERT OR REPLACE", true);
  std::string changes;
  for (const std::string_view column : split(columns, ',')) {
    changes += fmt::format("{0}{1} = excluded.{1}", changes.empty() ? "" : ", ", trim(column));
  }
  return fmt::format("{} ON CONFLICT ({}) DO UPDATE SET {}", insert(connection), unique, changes);
}

std::string SealedTable::select(const sql::Connection& connection, std::string_view rest,
                                std::string_view selected) const {
  return fmt::format("SELECT {}, {} FROM {} {}", selected.empty() ? columns : selected,
                     is_sound(connection), name, rest);
}

std::string SealedTable::is_sound(const sql::Connection& connection, std::string_view alias) const {
  if (!connection.dialect().has_seals) return "1";
  std::string prefixed;
  const std::string prefix = alias.empty() ? std::string() : fmt::format("{}.", alias);
  for (const std::string_view column : split(columns, ',')) {
    prefixed += fmt::format("{}{}{}", prefixed.empty() ? "" : ", ", prefix, trim(column));
  }
  return fmt::format("{}seal IS row_digest({})", prefix, prefixed);
}

std::string SealedTable::altered() const {
  return fmt::format("SELECT {} FROM {} WHERE seal IS NOT row_digest({})", key, name, columns);
}

std::span<const SealedTable> sealed_tables() { return kTables; }

Seal::Seal(sql::Connection& connection, const SealedTable& table)
    : is_sealed_(connection.dialect().has_seals),
      reseal_(connection, fmt::format("UPDATE {} SET seal = row_digest({}) WHERE {} = ?",
                                      table.name, table.columns, table.key)) {}

void Seal::renew(std::int64_t key) {
  if (is_sealed_) reseal_.run(key);
}

void require_sound(const sql::Rows& rows, int column, const SealedTable& table) {
  if (rows.get<bool>(column)) return;
  throw StorageFailure(
      Error{ErrorCode::StorageCorrupt,
            fmt::format("a row of {} does not match its seal: restore a backup", table.name)});
}

}  // namespace fitgauge::store
