#include "postgres/session.hpp"

#include <fmt/format.h>

#include <string_view>

#include "store/storage_failure.hpp"

namespace fitgauge::store::postgres {

Session::Session(const OpenOptions& options, const Clock& clock, std::int64_t daemon, Names& names)
    : connection_(options.address),
      stores_(connection_, clock, options.idempotency_retention),
      names_(names),
      head_(connection_, "SELECT last_id, own_rows, names FROM head"),
      locked_head_(connection_, "SELECT last_id, own_rows, names FROM head FOR UPDATE"),
      set_head_(connection_, "UPDATE head SET last_id = ?, own_rows = ?") {
  connection_.send(fmt::format("SET fitgauge.daemon = '{}'", daemon));
  if (options.synchronous != Synchronous::Full) connection_.send("SET synchronous_commit = off");
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

/// One notification for all that the transaction holds.
void Session::commit() {
  if (writes_) {
    const Head& head = connection_.head;
    if (head.last_id != begun_.last_id) set_head_.run(head.last_id, head.own_rows);
    connection_.send("SELECT pg_notify('fitgauge', '')");
  }
  connection_.take_warning();
  connection_.send("COMMIT");
  const ResultPtr committed = connection_.wait();
  // Of a transaction that failed before, COMMIT makes a ROLLBACK and calls it so.
  if (std::string_view(PQcmdStatus(committed.get())) != "COMMIT") {
    throw StorageFailure({ErrorCode::StorageUnavailable, "PostgreSQL has undone the transaction"});
  }
  // The one it has: the wait for a standby was ended, by an operator or by statement_timeout. What
  // is on this server alone is not acknowledged.
  if (const std::string warning = connection_.take_warning(); !warning.empty()) {
    throw StorageFailure({ErrorCode::StorageUnavailable,
                          fmt::format("PostgreSQL: {}", warning.substr(0, warning.find('\n')))});
  }
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
