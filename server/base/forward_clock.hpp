#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>

#include "base/clock.hpp"

namespace fitgauge {

/// The time of another clock that never goes back: what is recorded later has no earlier time. When
/// the other clock is set back, this one goes on from where it was, at half speed, until the other
/// has caught up. Set back by more than a day it had been wrong before: then its time is taken as
/// it is. Thread-safe; refers to the other clock, which outlives it.
class ForwardClock final : public Clock {
 public:
  /// Is told in one sentence when the other clock is a second or more behind, on the thread that
  /// asked for the time.
  using Report = std::function<void(const std::string&)>;

  ForwardClock(const Clock& other, Report report) : other_(other), report_(std::move(report)) {}

  Timestamp now() const override;

  /// As if `time` had been given: for what was recorded before the start.
  void begin_after(Timestamp time);

 private:
  /// Where the other clock was set back: what it said then, and the time that was given.
  struct SetBack {
    std::int64_t to_ns = 0;
    std::int64_t given_ns = 0;
  };

  std::optional<std::string> follow(std::int64_t other_ns) const;

  const Clock& other_;
  const Report report_;
  mutable std::mutex mutex_;
  mutable std::int64_t seen_ns_ = 0;   ///< of the other clock
  mutable std::int64_t given_ns_ = 0;  ///< by this one
  mutable std::optional<SetBack> set_back_;
};

}  // namespace fitgauge
