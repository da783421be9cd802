#include "postgres/listener.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <chrono>
#include <exception>
#include <string_view>

#include "sql/statement.hpp"
#include "store/storage_failure.hpp"

namespace fitgauge::store::postgres {
namespace {

constexpr std::chrono::milliseconds kLook{200};
constexpr std::chrono::milliseconds kBetweenAttempts{500};
constexpr std::chrono::seconds kBetweenFigures{5};

/// Who may not see the standbys of others sees how many there are.
constexpr const char* kFigures =
    "SELECT pg_database_size(current_database()), (SELECT count(*) FROM pg_stat_replication), "
    "(SELECT max(pg_wal_lsn_diff(pg_current_wal_lsn(), flush_lsn))::bigint FROM "
    "pg_stat_replication)";

struct Heard {
  bool commit = false;
  bool names = false;
};

/// What has come of notifications.
Heard hear(Connection& connection) {
  Heard heard;
  while (PGnotify* const notify = PQnotifies(connection.handle())) {
    heard.commit = true;
    heard.names |= std::string_view(notify->extra) == "names";
    PQfreemem(notify);
  }
  return heard;
}

ServerFigures read_figures(sql::Statement& figures) {
  sql::Rows rows = figures.query();
  rows.next();
  return {.database_bytes = rows.get<std::int64_t>(0),
          .standbys = rows.get<std::int64_t>(1),
          .standby_behind_bytes = rows.get<std::optional<std::int64_t>>(2)};
}

}  // namespace

Listener::Listener(std::string address, std::int64_t daemon, std::function<void(bool)> heard,
                   std::function<void(Figures)> told)
    : address_(std::move(address)),
      daemon_(daemon),
      heard_(std::move(heard)),
      told_(std::move(told)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}
Listener::~Listener() = default;

void Listener::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    try {
      listen(stop);
    } catch (const std::exception&) {  // the writer tells what is wrong with the database
      std::this_thread::sleep_for(kBetweenAttempts);
    }
    told_(std::nullopt);
  }
}

void Listener::listen(const std::stop_token& stop) {
  Connection connection(address_);
  connection.send("LISTEN fitgauge");
  connection.send(fmt::format("SELECT pg_advisory_lock_shared({}, {})", kDaemonLocks, daemon_));
  connection.wait();
  heard_(true);
  const int own = PQsocket(connection.handle());
  sql::Statement figures(connection, kFigures);
  auto due = std::chrono::steady_clock::now();
  while (!stop.stop_requested()) {
    if (const auto now = std::chrono::steady_clock::now(); now >= due) {
      told_(read_figures(figures));
      due = now + kBetweenFigures;
    }
    // What came with the figures is here already.
    if (const Heard heard = hear(connection); heard.commit) heard_(heard.names);
    pollfd socket{.fd = own, .events = POLLIN, .revents = 0};
    ::poll(&socket, 1, static_cast<int>(kLook.count()));
    if (socket.revents != 0 && PQconsumeInput(connection.handle()) != 1) return;
  }
}

}  // namespace fitgauge::store::postgres
