#include "postgres/listener.hpp"

#include <fmt/format.h>
#include <poll.h>

#include <chrono>
#include <exception>

#include "store/storage_failure.hpp"

namespace fitgauge::store::postgres {
namespace {

constexpr std::chrono::milliseconds kLook{200};
constexpr std::chrono::milliseconds kBetweenAttempts{500};

}  // namespace

Listener::Listener(std::string address, std::int64_t daemon, std::function<void()> heard)
    : address_(std::move(address)),
      daemon_(daemon),
      heard_(std::move(heard)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}
Listener::~Listener() = default;

void Listener::run(const std::stop_token& stop) {
  while (!stop.stop_requested()) {
    try {
      listen(stop);
    } catch (const std::exception&) {  // the writer tells what is wrong with the database
      std::this_thread::sleep_for(kBetweenAttempts);
    }
  }
}

void Listener::listen(const std::stop_token& stop) {
  Connection connection(address_);
  connection.send("LISTEN fitgauge");
  connection.send(fmt::format("SELECT pg_advisory_lock_shared({}, {})", kDaemonLocks, daemon_));
  connection.wait();
  heard_();
  const int own = PQsocket(connection.handle());
  while (!stop.stop_requested()) {
    pollfd socket{.fd = own, .events = POLLIN, .revents = 0};
    ::poll(&socket, 1, static_cast<int>(kLook.count()));
    if (socket.revents == 0) continue;
    if (PQconsumeInput(connection.handle()) != 1) return;
    bool heard = false;
    while (PGnotify* const notify = PQnotifies(connection.handle())) {
      PQfreemem(notify);
      heard = true;
    }
    if (heard) heard_();
  }
}

}  // namespace fitgauge::store::postgres
