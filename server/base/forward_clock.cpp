#include "base/forward_clock.hpp"

#include <fmt/format.h>

#include <utility>

namespace fitgauge {
namespace {

constexpr std::int64_t kDay = 86'400 * kNanosecondsPerSecond;

}  // namespace

Timestamp ForwardClock::now() const {
  std::optional<std::string> message;
  Timestamp time;
  {
    const std::lock_guard lock(mutex_);
    message = follow(other_.now().nanoseconds);
    time.nanoseconds = given_ns_;
  }
  if (message) report_(*message);
  return time;
}

void ForwardClock::begin_after(Timestamp time) {
  const std::lock_guard lock(mutex_);
  seen_ns_ = given_ns_ = time.nanoseconds;
}

/// Sets given_ns_. @returns what there is to report.
std::optional<std::string> ForwardClock::follow(std::int64_t other_ns) const {
  std::optional<std::string> message;
  if (other_ns < std::exchange(seen_ns_, other_ns)) {
    const std::int64_t behind = given_ns_ - other_ns;
    const bool too_far = behind > kDay;
    set_back_ = too_far ? std::nullopt : std::optional(SetBack{other_ns, given_ns_});
    if (too_far) given_ns_ = other_ns;
    if (behind >= kNanosecondsPerSecond) {
      message = fmt::format(
          "the machine's clock says {}, {} s before a time that was recorded: {}",
          format_rfc3339({other_ns}), behind / kNanosecondsPerSecond,
          too_far ? "it is taken as it is" : "times go on at half speed until it has caught up");
    }
  }
  if (set_back_) {
    given_ns_ = set_back_->given_ns + (other_ns - set_back_->to_ns) / 2;
    if (other_ns >= given_ns_) set_back_.reset();
  }
  if (!set_back_) given_ns_ = other_ns;
  return message;
}

}  // namespace fitgauge
