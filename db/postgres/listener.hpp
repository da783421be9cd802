#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <thread>

#include "postgres/connection.hpp"

namespace fitgauge::store::postgres {

/// The class of the advisory locks that daemons hold while they live.
inline constexpr int kDaemonLocks = 0x46744761;

/// Hears of the commits of all daemons, on a connection and a thread of its own, and holds the lock
/// that says this daemon lives. Where the connection is lost it is opened again, and what was not
/// heard meanwhile counts as heard.
class Listener {
 public:
  /// @param heard called on the thread, after one or more commits; must not block.
  Listener(std::string address, std::int64_t daemon, std::function<void()> heard);
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;
  ~Listener();

 private:
  void run(const std::stop_token& stop);
  void listen(const std::stop_token& stop);

  const std::string address_;
  const std::int64_t daemon_;
  const std::function<void()> heard_;
  std::jthread thread_;
};

}  // namespace fitgauge::store::postgres
