#pragma once

#include "db/sql/connection.hpp"
#include "db/sql/statement.hpp"

namespace fitgauge::store::sql {

/// One step of the schema. Steps are numbered from 1 without a gap and only go forward.
struct Migration {
  int number = 0;
  std::string_view name;
  std::string_view sql;
};

/// Compares the migrations of a database with `known`. @returns their number
/// @errors DatabaseNewer if it has more; DatabaseForeign if the text of a migration differs.
Result<int> check_steps(Connection& connection, std::span<const Migration> known);

void record_step(Connection& connection, const Migration& step, std::int64_t now_ns);

Error newer_database(std::int64_t found, std::size_t known);

}  // namespace fitgauge::store::sql

// The steps this build knows, from db/migrations.

namespace fitgauge::store::sqlite {
std::span<const sql::Migration> migrations();
}

namespace fitgauge::store::postgres {
std::span<const sql::Migration> migrations();
}

namespace fitgauge::store {

/// A table whose rows are sealed: its column `seal` is `row_digest` of the other columns, if the
/// engine has seals.
struct SealedTable {
  std::string_view name;
  std::string_view key;       ///< names a row in a finding; the primary key if it has one column
  std::string_view columns;   ///< separated by ", "; without an id that the database gives
  std::string_view unique{};  ///< columns that are unique together, for replace()

  /// `INSERT INTO … (columns, seal) VALUES (?1, …)`: the values of the columns, in their order.
  std::string insert(const sql::Connection& connection) const;
  /// Replaces a row that has equal `unique` columns. Triggers see a deletion and an insertion.
  std::string replace(const sql::Connection& connection) const;
  /// Selects columns (none: all) and, after them, whether the row is sound: for row_of().
  std::string select(const sql::Connection& connection, std::string_view rest,
                     std::string_view selected = {}) const;

  /// An expression of a SELECT: 0 if a row was altered.
  std::string is_sound(const sql::Connection& connection, std::string_view alias = {}) const;
  /// Selects the keys of altered rows. @pre the engine has seals.
  std::string altered() const;
};

inline constexpr SealedTable kTableSets{"table_sets", "id", "digest"};
inline constexpr SealedTable kTableRevisions{
    "table_revisions", "number", "digest, table_set, source, created_at, parent, caller"};
inline constexpr SealedTable kApiKeys{"api_keys", "id",
                                      "name, role, token_hash, created_at, revoked_at, expires_at"};
inline constexpr SealedTable kIdempotentAnswers{
    "idempotent_answers", "id",
    "key, caller, method, path, body_digest, status, content_type, location, body, expires_at, "
    "measurement"};
inline constexpr SealedTable kFileRevisions{"file_revisions", "revision",
                                            "path, path_key, content, modified_at, caller"};
inline constexpr SealedTable kDocuments{"documents", "name",
                                        "kind, name, text, modified_at, caller", "kind, name"};
inline constexpr SealedTable kChanges{
    "changes", "id", "id, at, caller, kind, name, action, before_text, after_text, leaf"};
inline constexpr SealedTable kRuns{
    "runs", "id", "status, program, program_key, request, result, created_at, finished_at, caller"};
inline constexpr SealedTable kRunTraces{"run_traces", "run", "run, trace"};
inline constexpr SealedTable kRunFiles{"run_files", "run", "run, name_key, path, content"};
inline constexpr SealedTable kLog{"log", "id", "origin, name, size"};
inline constexpr SealedTable kLogKeys{"log_keys", "number", "vkey, created_at"};
inline constexpr SealedTable kLogBranches{
    "log_branches", "number", "origin, name, size, last_row, last_run, last_event, last_note"};
inline constexpr SealedTable kLogMarks{"log_marks", "mark", "mark, reason"};
inline constexpr SealedTable kOrigins{"origins", "number", "digits, first_row, size, checkpoint"};
inline constexpr SealedTable kOriginKeys{"origin_keys", "number", "origin, vkey, created_at"};
inline constexpr SealedTable kOriginBases{"origin_bases", "origin", "origin, base, size"};
inline constexpr SealedTable kOriginForks{"origin_forks", "number",
                                          "origin, checkpoint, created_at"};
inline constexpr SealedTable kOriginRevisions{"origin_revisions", "number", "id"};
inline constexpr SealedTable kForwarding{"forwarding", "id", "id, centre, size", "id"};
inline constexpr SealedTable kReceived{"received", "name", "kind, name, number, digest",
                                       "kind, name"};
inline constexpr SealedTable kTableRevisionIds{"table_revision_ids", "revision", "revision, id"};
inline constexpr SealedTable kNotes{
    "notes", "id", "measurement, cause, measure, text, operator, caller, received_at"};
inline constexpr SealedTable kNoteOrigins{"note_origins", "note", "note, origin, number"};
inline constexpr SealedTable kEvents{"events", "id", "type, payload, created_at"};

std::span<const SealedTable> sealed_tables();

/// Seals a changed row again, if the engine has seals.
class Seal {
 public:
  Seal(sql::Connection& connection, const SealedTable& table);
  void renew(std::int64_t key);

 private:
  const bool is_sealed_;
  sql::Statement reseal_;
};

/// @throws StorageFailure (StorageCorrupt) unless the column is 1.
void require_sound(const sql::Rows& rows, int column, const SealedTable& table);

/// A value or an aggregate, and in the column after it whether the row is sound.
/// @throws as require_sound()
template <class T>
T row_of(const sql::Rows& rows, const SealedTable& table) {
  int columns = 1;
  if constexpr (std::is_aggregate_v<T> && !sql::kIsBytes<T>)
    columns = static_cast<int>(boost::pfr::tuple_size_v<T>);
  require_sound(rows, columns, table);
  return sql::row_of<T>(rows);
}

}  // namespace fitgauge::store
