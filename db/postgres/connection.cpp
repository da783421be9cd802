#include "db/postgres/connection.hpp"

#include <poll.h>

#include "db/store/stores.hpp"

namespace fitgauge::store::postgres {
namespace {

std::string first_line(std::string_view text) {
  return std::string(text.substr(0, text.find('\n')));
}

/// Classes of SQLSTATE that are not the statement's fault: connection, transaction rolled back,
/// resources, an operator's action, the system, a read-only server, and a table that is missing, as
/// during a restore.
constexpr std::array<std::string_view, 9> kOfTheServer = {"08", "40", "53", "54",   "57",
                                                          "58", "25", "55", "42P01"};
constexpr std::string_view kDamaged = "XX001";
constexpr std::string_view kDamagedIndex = "XX002";

/// Throws for a statement that failed: StorageFailure when the server, the connection or a limit is
/// to blame, std::logic_error when the statement is.
[[noreturn]] void throw_failure(const PGconn* connection, const PGresult* result) {
  const char* const found =
      result == nullptr ? nullptr : PQresultErrorField(result, PG_DIAG_SQLSTATE);
  const std::string_view state = found == nullptr ? "" : found;
  const std::string what =
      first_line(result == nullptr || state.empty() ? PQerrorMessage(connection)
                                                    : PQresultErrorMessage(result));
  if (state == kDamaged || state == kDamagedIndex) {
    throw StorageFailure({ErrorCode::StorageCorrupt, fmt::format("PostgreSQL: {}", what)});
  }
  bool of_the_server = state.empty() || PQstatus(connection) != CONNECTION_OK;
  for (const std::string_view known : kOfTheServer) of_the_server |= state.starts_with(known);
  if (of_the_server) {
    throw StorageFailure({ErrorCode::StorageUnavailable, fmt::format("PostgreSQL: {}", what)});
  }
  throw std::logic_error(fmt::format("PostgreSQL: {} ({})", what, state));
}

bool is_ok(const ResultPtr& result) {
  const ExecStatusType status = PQresultStatus(result.get());
  return status == PGRES_COMMAND_OK || status == PGRES_TUPLES_OK;
}

constexpr sql::Dialect kDialect{.is_shared = true, .keys_may_be_null = true};

/// Settings of each session: bounds, so that nobody waits for ever for a server, a row or a lost
/// client.
constexpr const char* kSettings =
    "SET search_path TO fitgauge; SET lock_timeout = '30s';"
    "SET idle_in_transaction_session_timeout = '60s'; SET client_min_messages = warning;"
    "SET jit = off; SET bytea_output = hex; SET plan_cache_mode = auto";

PGconn* open(const std::string& address) {
  // Settings before the address can be overridden in it.
  const std::array<const char*, 8> keys = {
      "target_session_attrs", "connect_timeout", "application_name", "keepalives_idle",
      "tcp_user_timeout",     "dbname",          "client_encoding",  nullptr};
  const std::array<const char*, 8> values = {"read-write",    "3",    "fitgauged", "10", "15000",
                                             address.c_str(), "UTF8", nullptr};
  return PQconnectdbParams(keys.data(), values.data(), 1);
}

}  // namespace

Connection::Connection(const std::string& address, GivesUp gives_up)
    : sql::Connection(kDialect), connection_(open(address)), gives_up_(std::move(gives_up)) {
  if (PQstatus(handle()) != CONNECTION_OK) throw_failure(handle(), nullptr);
  if (PQsetnonblocking(handle(), 1) != 0) lost();
  PQsetNoticeReceiver(handle(), on_notice, this);
  execute(fmt::format("SET statement_timeout = '{}s'; {}", kStatementSeconds, kSettings));
  if (PQenterPipelineMode(handle()) != 1) throw_failure(handle(), nullptr);
}

void Connection::on_notice(void* connection, const PGresult* notice) {
  static_cast<Connection*>(connection)->warning_ = PQresultErrorMessage(notice);
}

Connection::~Connection() { measurements_.reset(); }

std::unique_ptr<sql::Prepared> Connection::prepare(const std::string& sql) {
  return std::make_unique<Prepared>(*this, sql);
}

sql::MeasurementTable& Connection::measurements() {
  if (!measurements_) measurements_ = std::make_unique<MeasurementTable>(*this);
  return *measurements_;
}

void Connection::lost() { throw_failure(handle(), nullptr); }

void Connection::require_sent(int sent) {
  if (sent != 1) lost();
}

void Connection::send(const std::string& sql) {
  require_sent(PQsendQueryParams(handle(), sql.c_str(), 0, nullptr, nullptr, nullptr, nullptr, 1));
  sent_.emplace_back();
}

void Connection::send(const std::string& name, const std::string& sql,
                      std::span<const Parameter> values) {
  while (!unused_.empty()) {
    send("DEALLOCATE " + unused_.back());
    unused_.pop_back();
  }
  if (!prepared_.contains(name)) {
    std::vector<Oid> types;
    for (const Parameter& value : values) types.push_back(value.type);
    require_sent(PQsendPrepare(handle(), name.c_str(), sql.c_str(), static_cast<int>(types.size()),
                               types.data()));
    sent_.push_back(name);
    prepared_.insert(name);
  }
  std::vector<const char*> data;
  std::vector<int> sizes;
  const std::vector<int> formats(values.size(), 1);
  std::vector<std::string> numbers(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    const Parameter& value = values[i];
    if (value.is_null) {
      data.push_back(nullptr);
      sizes.push_back(0);
    } else if (value.type == kInt8) {
      append_number(numbers[i], value.integer);
      data.push_back(numbers[i].data());
      sizes.push_back(sizeof(std::int64_t));
    } else {
      data.push_back(value.bytes.data() == nullptr ? "" : value.bytes.data());
      sizes.push_back(static_cast<int>(value.bytes.size()));
    }
  }
  require_sent(PQsendQueryPrepared(handle(), name.c_str(), static_cast<int>(values.size()),
                                   data.data(), sizes.data(), formats.data(), 1));
  sent_.emplace_back();
}

/// Returns when libpq need not wait for the server: there is a result, or the connection is lost.
void Connection::await_result() {
  constexpr int kSecond = 1000;
  for (int silent = 0; !is_given_up_;) {
    const int unsent = PQflush(handle());
    if (unsent < 0 || PQisBusy(handle()) == 0) return;
    const int events = unsent > 0 ? POLLIN | POLLOUT : POLLIN;
    pollfd server{.fd = PQsocket(handle()), .events = static_cast<short>(events), .revents = 0};
    const int ready = ::poll(&server, 1, kSecond);
    if (ready == 0) is_given_up_ = gives_up_(++silent);
    if (ready <= 0) continue;
    silent = 0;
    if ((server.revents & ~POLLOUT) != 0 && PQconsumeInput(handle()) != 1) return;
  }
  throw StorageFailure({ErrorCode::StorageUnavailable, kNoAnswer});
}

ResultPtr Connection::next_result() {
  await_result();
  return ResultPtr(PQgetResult(handle()));
}

ResultPtr Connection::wait() {
  if (sent_.empty()) return nullptr;
  if (PQpipelineSync(handle()) != 1) lost();
  std::vector<std::string> sent = std::exchange(sent_, {});
  has_committed_ = false;
  ResultPtr failed;
  ResultPtr last;
  for (const std::string& prepares : sent) {
    ResultPtr result = next_result();
    if (!result || PQstatus(handle()) != CONNECTION_OK) {
      if (result && !failed) failed = std::move(result);
      if (failed) throw_failure(handle(), failed.get());
      lost();
    }
    const bool ok = is_ok(result);
    has_committed_ |= std::string_view(PQcmdStatus(result.get())) == "COMMIT";
    if (!ok && !prepares.empty()) prepared_.erase(prepares);
    if (!ok && !failed) {
      failed = std::move(result);
    } else {
      last = std::move(result);
    }
    while (next_result()) {
    }
  }
  const ResultPtr sync = next_result();
  if (!sync || PQresultStatus(sync.get()) != PGRES_PIPELINE_SYNC) lost();
  if (failed) throw_failure(handle(), failed.get());
  return last;
}

void Connection::wait_for_commit() {
  try {
    wait();
  } catch (const std::logic_error& failed) {
    if (!has_committed_) throw;
    throw StorageFailure({ErrorCode::StorageUnavailable, failed.what()});
  }
  // PostgreSQL answers ROLLBACK to the COMMIT of a transaction that failed earlier.
  if (has_committed_) return;
  throw StorageFailure({ErrorCode::StorageUnavailable, "PostgreSQL rolled the transaction back"});
}

/// @pre the connection is in no pipeline.
void Connection::execute(const std::string& sql) {
  require_sent(PQsendQuery(handle(), sql.c_str()));
  ResultPtr failed;
  while (ResultPtr result = next_result()) {
    if (!is_ok(result) && !failed) failed = std::move(result);
  }
  if (failed) throw_failure(handle(), failed.get());
}

void Connection::run_script(const std::string& sql) {
  if (is_waiting()) wait();
  if (PQexitPipelineMode(handle()) != 1) lost();
  execute(sql);
  if (PQenterPipelineMode(handle()) != 1) lost();
}

void Connection::forget(const std::string& name) noexcept {
  if (prepared_.erase(name) == 0) return;
  try {
    unused_.push_back(name);
  } catch (const std::bad_alloc&) {  // the server keeps one statement more
  }
}

}  // namespace fitgauge::store::postgres
