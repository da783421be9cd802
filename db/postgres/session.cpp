#include "postgres/session.hpp"

#include <fmt/format.h>

#include <string_view>

#include "store/storage_failure.hpp"

namespace fitgauge::store::postgres {
namespace {

/// Positions in the WAL as numbers. What a transaction sees was written before its first statement.
constexpr const char* kHead =
    "SELECT last_id, own_rows, names, (pg_current_wal_insert_lsn() - '0/0')::bigint FROM head";
constexpr const char* kFlushed = "SELECT (pg_current_wal_flush_lsn() - '0/0')::bigint";

/// The commit frees the row before the WAL is on the disk, and flush() waits for that. Not where a
/// standby has to have it, as reading would then wait for the standby; nor with new names, which
/// daemons keep in memory beyond a crash of the server.
constexpr const char* kReleaseEarly =
    "SELECT set_config('synchronous_commit', 'off', true) FROM head"
    " WHERE names = ? AND current_setting('synchronous_standby_names') = ''";

}  // namespace

Session::Session(const OpenOptions& options, const Clock& clock, std::int64_t daemon, Names& names)
    : connection_(options.address),
      stores_(connection_, clock, options.idempotency_retention),
      names_(names),
      is_durable_(options.synchronous == Synchronous::Full),
      head_(connection_, kHead),
      locked_head_(connection_, std::string(kHead) + " FOR UPDATE"),
      set_head_(connection_, "UPDATE head SET last_id = ?, own_rows = ?"),
      release_early_(connection_, kReleaseEarly),
      flushed_(connection_, kFlushed) {
  connection_.send(fmt::format("SET fitgauge.daemon = '{}'", daemon));
  if (!is_durable_) connection_.send("SET synchronous_commit = off");
  connection_.wait();
}

void Session::read_head(sql::Statement& head) {
  {
    sql::Rows rows = head.query();
    if (!rows.next()) {
      throw StorageFailure({ErrorCode::StorageCorrupt, "the database has lost its row head"});
    }
    connection_.head = {.last_id = rows.get<std::int64_t>(0),
                        .own_rows = rows.get<std::int64_t>(1),
                        .names = rows.get<std::int64_t>(2)};
    seen_wal_ = rows.get<std::int64_t>(3);
  }
  begun_ = connection_.head;
  names_.look(connection_.head.names, stores_);
}

void Session::begin_reading() {
  writes_ = false;
  connection_.send("BEGIN ISOLATION LEVEL REPEATABLE READ READ ONLY");
  read_head(head_);
}

void Session::begin_writing() {
  writes_ = true;
  connection_.send("BEGIN ISOLATION LEVEL READ COMMITTED READ WRITE");
  read_head(locked_head_);
}

void Session::commit() { writes_ ? commit_written() : commit_read(); }

/// One notification for all that the transaction holds.
void Session::commit_written() {
  const Head& head = connection_.head;
  if (head.last_id != begun_.last_id) set_head_.run(head.last_id, head.own_rows);
  connection_.send("SELECT pg_notify('fitgauge', '')");
  if (is_durable_) release_early_.run(begun_.names);
  connection_.take_warning();
  connection_.send("COMMIT");
  const ResultPtr committed = connection_.wait();
  // Of a transaction that failed before, COMMIT makes a ROLLBACK and calls it so.
  if (std::string_view(PQcmdStatus(committed.get())) != "COMMIT") {
    throw StorageFailure({ErrorCode::StorageUnavailable, "PostgreSQL has undone the transaction"});
  }
  if (is_durable_) flush("SELECT 1");
  // The one it has: the wait for a standby was ended, by an operator or by statement_timeout. What
  // is on this server alone is not acknowledged.
  if (const std::string warning = connection_.take_warning(); !warning.empty()) {
    throw StorageFailure({ErrorCode::StorageUnavailable,
                          fmt::format("PostgreSQL: {}", warning.substr(0, warning.find('\n')))});
  }
}

/// What was read may be of a commit that is not on the disk yet: nobody hears of it before it is.
void Session::commit_read() {
  connection_.send("COMMIT");
  if (!is_durable_ || flushed_.returning<std::int64_t>() >= seen_wal_) return settle();
  flush("SELECT set_config('synchronous_commit', 'local', true)");
}

/// The WAL is one: with a commit of its own on the disk are all before it. PostgreSQL waits only for
/// the disk when the transaction has written something, be it an empty message to nobody.
void Session::flush(const char* setting) {
  connection_.send(fmt::format("{}, pg_logical_emit_message(true, 'fitgauge', '')", setting));
  connection_.wait();
}

void Session::rollback() noexcept {
  try {
    connection_.send("ROLLBACK");
    connection_.wait();
  } catch (const std::exception&) {  // the session ends, and with it the transaction
  }
}

void Session::savepoint() {
  before_job_ = connection_.head;
  connection_.send("SAVEPOINT job");
}

void Session::undo() {
  connection_.abandon_copy();
  connection_.head = before_job_;
  connection_.parts_may_be_undone = true;
  connection_.send("ROLLBACK TO job");
}

void Session::settle() {
  if (connection_.is_waiting()) connection_.wait();
}

void Session::release() { connection_.send("RELEASE job"); }

void Session::probe() {
  connection_.send("UPDATE head SET probes = probes + 1");
  connection_.wait();
}

}  // namespace fitgauge::store::postgres
