#include "db/postgres/session.hpp"

#include <poll.h>

#include "db/sql/statement.hpp"
#include "db/store/stores.hpp"

namespace fitgauge::store::postgres {
namespace {

constexpr std::chrono::milliseconds kBetweenAttempts{500};
constexpr std::chrono::seconds kBetweenFigures{5};
constexpr std::chrono::seconds kBetweenProbes{1};
constexpr int kLongestSilence = 3;  ///< seconds

/// A role that must not see the standbys sees their number.
constexpr const char* kFigures =
    "SELECT pg_database_size(current_database()), (SELECT count(*) FROM pg_stat_replication), "
    "(SELECT max(pg_wal_lsn_diff(pg_current_wal_lsn(), flush_lsn))::bigint FROM "
    "pg_stat_replication)";

/// Sends an empty message too, so that the commit waits for the disk (Session): readers then need
/// not wait.
constexpr const char* kNotify =
    "SELECT pg_logical_emit_message(true, 'fitgauge', ''), pg_notify('fitgauge', '')";

struct Heard {
  bool commit = false;
  bool names = false;
};

/// Notifications that have arrived.
Heard hear(Connection& connection) {
  Heard heard;
  while (PGnotify* const notify = PQnotifies(connection.handle())) {
    heard.commit = true;
    heard.names |= std::string_view(notify->extra) == "names";
    PQfreemem(notify);
  }
  return heard;
}

/// Waits until one of the two is readable. @returns whether `wake_up` is.
bool wait_for(int socket, int wake_up, Notifications::Clock::duration patience) {
  using std::chrono::milliseconds;
  const auto longest = std::max(std::chrono::ceil<milliseconds>(patience), milliseconds(0));
  std::array<pollfd, 2> sources{pollfd{.fd = socket, .events = POLLIN, .revents = 0},
                                pollfd{.fd = wake_up, .events = POLLIN, .revents = 0}};
  ::poll(sources.data(), sources.size(), static_cast<int>(longest.count()));
  eventfd_t times = 0;
  return eventfd_read(wake_up, &times) == 0;
}

/// Other daemons find the mark when they sign, and the next start begins a branch.
void mark_set_back(Connection& connection) {
  connection.send("ROLLBACK");
  connection.send(
      "INSERT INTO log_marks VALUES ('forked', 'an older copy of the database was restored while "
      "services used it: restart them') ON CONFLICT DO NOTHING");
  connection.wait();
}

}  // namespace

Listener::Listener(std::string address, std::int64_t daemon, Notifications& notifications,
                   std::function<void(bool)> heard, std::function<void(Figures)> told)
    : address_(std::move(address)),
      daemon_(daemon),
      notifications_(notifications),
      heard_(std::move(heard)),
      told_(std::move(told)),
      thread_("store listener", [this](const std::stop_token& stop) { run(stop); }) {}

Listener::~Listener() {
  thread_.request_stop();
  notifications_.wake_listener();
}

void Listener::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    bool has_failed = false;
    try {
      listen(stop);
    } catch (const std::exception&) {  // the writer reports faults of the database
      has_failed = true;
    }
    notifications_.postpone();  // the notification may be lost
    if (stop.stop_requested()) return;
    told_(std::nullopt);
    if (ends_when_away_) return;
    if (has_failed) std::this_thread::sleep_for(kBetweenAttempts);
  }
}

void Listener::listen(const std::stop_token& stop) {
  Connection connection(address_, [](int seconds) { return seconds >= kLongestSilence; });
  connection.send("SET synchronous_commit = local");  // a standby does not need notifications
  connection.send("LISTEN fitgauge");
  connection.send(fmt::format("SELECT pg_advisory_lock_shared({}, {})", kDaemonLocks, daemon_));
  connection.wait();
  heard_(true);
  const int own = PQsocket(connection.handle());
  sql::Statement figures(connection, kFigures);
  sql::Statement notify(connection, kNotify);
  sql::Statement probe(connection, "SELECT 1::bigint");
  const auto notify_postponed = [&] {
    if (!notifications_.take_postponed()) return;
    notify.run();
    connection.wait();
  };
  auto look_at = Notifications::Clock::now();
  auto notify_at = look_at;  // what another connection left
  auto probe_at = look_at;
  while (!stop.stop_requested()) {
    const auto now = Notifications::Clock::now();
    if (now >= look_at) {
      told_(read_first<ServerFigures>(figures.query()));
      heard_(false);
      look_at = now + kBetweenFigures;
    }
    if (now >= probe_at) {
      probe.returning<std::int64_t>();
      probe_at = now + kBetweenProbes;
    }
    if (now >= notify_at) {
      notify_postponed();
      notify_at = Notifications::Clock::time_point::max();
    }
    // Notifications that came with the figures are here already.
    if (const Heard heard = hear(connection); heard.commit) heard_(heard.names);
    if (wait_for(own, notifications_.wake_up(), std::min({look_at, notify_at, probe_at}) - now)) {
      notify_at = std::min(notify_at, Notifications::Clock::now() + Notifications::kInterval);
    }
    if (PQconsumeInput(connection.handle()) != 1) return;
  }
  notify_postponed();
}

void Position::saw(std::int64_t last_id) {
  std::int64_t newest = newest_;
  while (newest < last_id && !newest_.compare_exchange_weak(newest, last_id)) {
  }
}

void Position::require() const {
  const std::lock_guard lock(mutex_);
  if (!why_.empty()) throw StorageFailure({ErrorCode::StorageUnavailable, why_});
}

bool Position::is_first_row(std::int64_t version) {
  std::int64_t known = 0;
  return version != 0 && (first_row_.compare_exchange_strong(known, version) || known == version);
}

void Position::restored() {
  const std::string why = "the database was restored, or is being restored";
  if (first_row_ != 0) set_back(why);
  require();
  throw StorageFailure({ErrorCode::StorageUnavailable, why});
}

void Position::set_back(const std::string& why) {
  {
    const std::lock_guard lock(mutex_);
    if (!why_.empty()) return;
    why_ = why + ": restart this service";
  }
  if (set_back_) set_back_(why_);
}

Session::Session(const OpenOptions& options, const Clock& clock, std::int64_t daemon, Names& names,
                 Position& position, Notifications& notifications, GivesUp gives_up)
    : connection_(options.address, std::move(gives_up)),
      stores_(connection_, clock, options.idempotency_retention),
      names_(names),
      position_(position),
      notifications_(notifications),
      is_durable_(options.synchronous == Synchronous::Full) {
  connection_.send(fmt::format("SET fitgauge.daemon = '{}'", daemon));
  if (!is_durable_) connection_.send("SET synchronous_commit = off");
  connection_.wait();
}

/// @param newest known before the transaction, which may see less than is known now.
void Session::require_position(std::int64_t newest) {
  if (connection_.head.last_id >= newest) return;
  position_.set_back(
      fmt::format("PostgreSQL has {} measurements and had {}: an older copy was restored",
                  connection_.head.last_id, newest));
  mark_set_back(connection_);
  position_.require();
}

void Session::read_head(sql::Statement& head) {
  position_.require();
  const std::int64_t newest = position_.newest();
  {
    sql::Rows rows = head.query();
    if (!rows.next() || !position_.is_first_row(rows.get<std::int64_t>(4))) {
      position_.restored();
    }
    connection_.head = {.last_id = rows.get<std::int64_t>(0),
                        .own_rows = rows.get<std::int64_t>(1),
                        .names = rows.get<std::int64_t>(2)};
    seen_wal_ = rows.get<std::int64_t>(3);
  }
  require_position(newest);
  begun_ = connection_.head;
  names_.look(connection_.head.names, stores_, is_new_);
  is_new_ = false;
}

void Session::begin_reading() {
  writes_ = false;
  begin_reading_.run();
  read_head(head_);
}

void Session::begin_writing() {
  writes_ = true;
  begin_writing_.run();
  queue_for_head_.run();
  read_head(locked_head_);
}

/// One exchange with the server for everything that the jobs have postponed.
void Session::commit_written() {
  const Head& head = connection_.head;
  const bool notifies = notifications_.is_due();
  set_head_.run(head.last_id, head.own_rows, begun_.names, notifies ? 1 : 0);
  connection_.take_warning();
  commit_.run();
  flush_.run();
  connection_.wait_for_commit();
  notifications_.committed(notifies);
  // Checks the warning of the result: an operator or statement_timeout ended the wait for a
  // standby. Data on only this server is not acknowledged.
  if (const std::string warning = connection_.take_warning(); !warning.empty()) {
    throw StorageFailure({ErrorCode::StorageUnavailable,
                          fmt::format("PostgreSQL: {}", warning.substr(0, warning.find('\n')))});
  }
  if (is_durable_) position_.saw(head.last_id);
}

/// Rows may belong to a commit that is not yet on the disk: nobody sees them before.
void Session::commit_read() {
  commit_.run();
  if (!is_durable_) return settle();
  if (flushed_.returning<std::int64_t>() < seen_wal_) flush_here_.run();
  settle();
  position_.saw(begun_.last_id);
}

void Session::rollback() noexcept {
  connection_.parts_may_be_undone = true;
  try {
    settle_undone();
    connection_.send("ROLLBACK");
    connection_.wait();
  } catch (const std::exception&) {  // the session ends, and with it the transaction
  }
}

/// Statements after a failed statement are not executed.
void Session::settle_undone() {
  try {
    settle();
  } catch (const std::logic_error&) {  // concerns work that is rolled back
  }
}

void Session::savepoint() {
  before_job_ = connection_.head;
  savepoint_.run();
}

void Session::undo() {
  settle_undone();
  connection_.head = before_job_;
  connection_.parts_may_be_undone = true;
  connection_.send("ROLLBACK TO job");
}

void Session::settle() {
  if (connection_.is_waiting()) connection_.wait();
}

void Session::probe() {
  position_.require();
  connection_.send("UPDATE head SET probes = probes + 1");
  connection_.wait();
}

}  // namespace fitgauge::store::postgres
