#pragma once

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/steady_time.hpp"

namespace fitgauge {

/// The time of another clock that never goes back: a later record has no earlier time. After the
/// other clock was set back, this clock continues from the last time that it gave, at half speed,
/// until the other clock has caught up. Compares the other clock with one that nobody sets and
/// reports each jump of a second or more. Thread-safe; the other clock outlives it.
class ForwardClock final : public Clock {
 public:
  /// The time since the machine's start, sleep included (CLOCK_BOOTTIME): nobody sets it.
  using Running = std::function<std::chrono::nanoseconds()>;
  /// Receives `clock_set_back` or `clock_set_ahead` and a sentence, on the thread that asked for
  /// the time.
  using Report = std::function<void(std::string_view event, const std::string& detail)>;

  ForwardClock(const Clock& other, Running running, Report report);

  Timestamp now() const override;

  /// The other clock's time, which deletions go by.
  SteadyTime steady() const;

  /// As if `time` had been given, for records from before the start.
  void begin_after(Timestamp time);

  static std::chrono::nanoseconds running_time();

 private:
  /// The other clock's time and the running time around its reading.
  struct Reading {
    std::chrono::nanoseconds before{};
    std::int64_t ns = 0;
    std::chrono::nanoseconds after{};
  };
  /// The other clock's time when it was set back, and the time that this clock had given.
  struct SetBack {
    std::int64_t to_ns = 0;
    std::int64_t given_ns = 0;
  };
  struct Jump {
    std::string_view event;
    std::string detail;
  };
  using Jumps = std::vector<Jump>;

  Reading read() const;
  SteadyTime look(Jumps& jumps) const;
  void compare(const Reading& reading, Jumps& jumps) const;
  void follow(std::int64_t other_ns, Jumps& jumps) const;
  void report(const Jumps& jumps) const;

  const Clock& other_;
  const Running running_;
  const Report report_;
  mutable std::mutex mutex_;
  mutable Reading last_;
  mutable std::chrono::nanoseconds held_{};  ///< running time since the last jump
  mutable std::int64_t seen_ns_ = 0;         ///< of the other clock
  mutable std::int64_t given_ns_ = 0;        ///< by this one
  mutable std::optional<SetBack> set_back_;
};

}  // namespace fitgauge
