#pragma once

#include <sys/eventfd.h>
#include <unistd.h>

#include <atomic>
#include <chrono>

namespace fitgauge::store::postgres {

/// When the commits of this daemon are told to all. Each telling wakes every daemon and a session
/// of it on the server, so many commits are told as one: a transaction tells of itself when the
/// last telling is 20 ms ago, and what it would have told is else owed. The next one pays, or the
/// listener where there is none for so long. A daemon that is killed pays nothing.
class Tellings {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::milliseconds kBetween{20};

  Tellings() = default;
  Tellings(const Tellings&) = delete;
  Tellings& operator=(const Tellings&) = delete;
  ~Tellings() { close(bell_); }

  /// Of the writer: whether the transaction is to tell of itself.
  bool is_due() {
    const auto now = Clock::now();
    const bool due = now >= next_;
    if (due) next_ = now + kBetween;
    return due;
  }
  /// Of the writer: it has committed.
  void committed(bool told) {
    if (told) {
      untold_ = false;
    } else {
      owe();
    }
  }

  /// Thread-safe; rings where nothing was owed before.
  void owe() {
    if (!untold_.exchange(true)) ring();
  }
  /// @returns whether something was owed; who takes it tells it.
  bool take() { return untold_.exchange(false); }

  void ring() const { eventfd_write(bell_, 1); }
  /// To be polled; has something to read once it has rung.
  int bell() const { return bell_; }

 private:
  const int bell_ = eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC);
  std::atomic<bool> untold_{false};
  Clock::time_point next_{};
};

}  // namespace fitgauge::store::postgres
