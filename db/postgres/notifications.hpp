#pragma once

#include <sys/eventfd.h>
#include <unistd.h>

#include <atomic>
#include <chrono>

namespace fitgauge::store::postgres {

/// When commits of this daemon are notified. Each NOTIFY wakes every daemon and a session of it on
/// the server, so there is one for all commits within 20 ms: a transaction notifies when the last
/// one is that long ago, and is postponed else. The next one then notifies for both, or the
/// listener where there is none for so long. What a killed daemon has postponed is lost.
class Notifications {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kInterval{20};

  Notifications() = default;
  Notifications(const Notifications&) = delete;
  Notifications& operator=(const Notifications&) = delete;
  ~Notifications() { close(event_); }

  /// Of the writer: whether the transaction is to notify.
  bool is_due() {
    const auto now = Clock::now();
    const bool due = now >= next_;
    if (due) next_ = now + kInterval;
    return due;
  }
  /// Of the writer: it has committed.
  void committed(bool notified) {
    if (notified) {
      postponed_ = false;
    } else {
      postpone();
    }
  }

  /// Thread-safe; wakes the listener where nothing was postponed before.
  void postpone() {
    if (!postponed_.exchange(true)) wake_listener();
  }
  /// @returns whether something was postponed; who takes it notifies.
  bool take_postponed() { return postponed_.exchange(false); }

  void wake_listener() const { eventfd_write(event_, 1); }
  /// The descriptor that the listener polls: readable once it was woken.
  int wake_up() const { return event_; }

 private:
  const int event_ = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  std::atomic<bool> postponed_{false};
  Clock::time_point next_{};
};

}  // namespace fitgauge::store::postgres
