#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>

#include "base/thread.hpp"
#include "db/postgres/connection.hpp"
#include "db/postgres/notifications.hpp"
#include "db/store/writer_counters.hpp"

namespace fitgauge::store::postgres {

/// The class of the advisory locks that daemons hold while they live.
inline constexpr int kDaemonLocks = 0x46744761;

/// Hears of the commits of all daemons, notifies what this one has postponed, on a connection and a
/// thread of its own, and holds the lock that says this daemon lives. Where the connection is lost
/// it is opened again, and what was not heard meanwhile counts as heard. Every few seconds it looks
/// at what the server says of itself, and as if it had heard: a killed daemon may not have
/// notified.
class Listener {
 public:
  using Figures = std::optional<ServerFigures>;  ///< nothing while the server is away

  /// @param notifications outlive it.
  /// @param heard called on the thread, after one or more commits, with whether one of them has
  ///   changed names (store::postgres::Names); must not block.
  /// @param told called on the thread with what is new; must not block.
  Listener(std::string address, std::int64_t daemon, Notifications& notifications,
           std::function<void(bool names)> heard, std::function<void(Figures)> told);
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  /// Notifies what is postponed.
  ~Listener();

 private:
  void run(const std::stop_token& stop);
  void listen(const std::stop_token& stop);

  const std::string address_;
  const std::int64_t daemon_;
  Notifications& notifications_;
  const std::function<void(bool names)> heard_;
  const std::function<void(Figures)> told_;
  Thread thread_;
};

}  // namespace fitgauge::store::postgres
