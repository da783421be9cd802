#include "db/postgres/listener.hpp"

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

}  // namespace fitgauge::store::postgres
