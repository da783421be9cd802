#pragma once

#include <sys/eventfd.h>
#include <unistd.h>

#include "base/thread.hpp"
#include "db/postgres/connection.hpp"
#include "db/store/database.hpp"

namespace fitgauge::store::postgres {

/// Decides when commits of this daemon are notified. Each NOTIFY wakes every daemon and one of its
/// sessions on the server, so there is one for all commits within 20 ms: a transaction notifies if
/// the last one is that long ago, and is postponed otherwise. The next transaction then notifies
/// for both, or the listener if there is none in time. Postponed notifications of a killed daemon
/// are lost.
class Notifications {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kInterval{20};

  Notifications& operator=(Notifications&&) = delete;  // neither copied nor moved
  ~Notifications() { close(event_); }

  /// Returns whether the transaction notifies others. Only the writer calls it.
  bool is_due() {
    const auto now = Clock::now();
    const bool due = now >= next_;
    if (due) next_ = now + kInterval;
    return due;
  }
  /// Records a commit. Only the writer calls it.
  void committed(bool notified) {
    if (notified) {
      postponed_ = false;
    } else {
      postpone();
    }
  }

  /// Thread-safe; wakes the listener if nothing was postponed before.
  void postpone() {
    if (!postponed_.exchange(true)) wake_listener();
  }
  /// @returns whether something was postponed; then the caller must notify.
  bool take_postponed() { return postponed_.exchange(false); }

  void wake_listener() const { eventfd_write(event_, 1); }
  /// The descriptor that the listener polls: readable once it was woken.
  int wake_up() const { return event_; }

 private:
  const int event_ = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  std::atomic<bool> postponed_{false};
  Clock::time_point next_{};
};

/// Class of the advisory locks that living daemons hold.
inline constexpr int kDaemonLocks = 0x46744761;

/// Receives the notifications of all daemons and sends the postponed ones of this daemon, on its
/// own connection and thread. Holds the lock that shows that this daemon is alive. Opens a lost
/// connection again and then reports a notification, because some may be lost. Every few seconds it
/// reads the state of the server and reports a notification, because a killed daemon may not have
/// notified.
class Listener {
 public:
  using Figures = std::optional<ServerFigures>;  ///< absent while the server is unreachable

  /// @param notifications must outlive it.
  /// @param heard called on the thread after one or more commits, with whether one of them has
  /// changed names (store::postgres::Names); must not block.
  /// @param told called on the thread with changes of the server's state; must not block.
  Listener(std::string address, std::int64_t daemon, Notifications& notifications,
           std::function<void(bool names)> heard, std::function<void(Figures)> told);
  Listener& operator=(Listener&&) = delete;  // neither copied nor moved
  /// Sends the postponed notification.
  ~Listener();

  /// Ends as soon as the server is unreachable, instead of connecting again.
  void end_when_away() { ends_when_away_ = true; }

 private:
  void run(const std::stop_token& stop);
  void listen(const std::stop_token& stop);

  const std::string address_;
  const std::int64_t daemon_;
  Notifications& notifications_;
  const std::function<void(bool names)> heard_;
  const std::function<void(Figures)> told_;
  std::atomic<bool> ends_when_away_{false};
  Thread thread_;
};

}  // namespace fitgauge::store::postgres
