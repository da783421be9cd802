#include "base/forward_clock.hpp"

#include <fmt/format.h>
#include <time.h>

#include <algorithm>
#include <utility>

namespace fitgauge {
namespace {

using std::chrono::nanoseconds;

constexpr nanoseconds kLeastJump = std::chrono::seconds(1);
/// Between two looks the machine may have slept: no more of that time counts as running.
constexpr nanoseconds kLongestRun = std::chrono::seconds(5);

}  // namespace

ForwardClock::ForwardClock(const Clock& other, Running running, Report report)
    : other_(other), running_(std::move(running)), report_(std::move(report)), last_(read()) {}

Timestamp ForwardClock::now() const {
  Jumps jumps;
  Timestamp time;
  {
    const std::lock_guard lock(mutex_);
    look(jumps);
    time.nanoseconds = given_ns_;
  }
  report(jumps);
  return time;
}

SteadyTime ForwardClock::steady() const {
  Jumps jumps;
  SteadyTime time;
  {
    const std::lock_guard lock(mutex_);
    time = look(jumps);
  }
  report(jumps);
  return time;
}

void ForwardClock::begin_after(Timestamp time) {
  const std::lock_guard lock(mutex_);
  seen_ns_ = given_ns_ = time.nanoseconds;
}

nanoseconds ForwardClock::running_time() {
  timespec time{};
  clock_gettime(CLOCK_BOOTTIME, &time);
  return std::chrono::seconds(time.tv_sec) + nanoseconds(time.tv_nsec);
}

ForwardClock::Reading ForwardClock::read() const {
  Reading reading;
  reading.before = running_();
  reading.ns = other_.now().nanoseconds;
  reading.after = running_();
  return reading;
}

SteadyTime ForwardClock::look(Jumps& jumps) const {
  const Reading reading = read();
  compare(reading, jumps);
  follow(reading.ns, jumps);
  return {.time = {reading.ns}, .held = held_};
}

/// A thread that stood still between two clocks saw no jump: the running time is the longest that
/// may have passed against a clock ahead, the shortest against one that was set back.
void ForwardClock::compare(const Reading& reading, Jumps& jumps) const {
  const nanoseconds passed(reading.ns - last_.ns);
  const nanoseconds longest = reading.after - last_.before;
  const nanoseconds shortest = reading.before - last_.after;
  held_ += std::clamp(shortest, nanoseconds(0), kLongestRun);
  last_ = reading;
  const bool ahead = passed - longest >= kLeastJump;
  if (ahead || shortest - passed >= kLeastJump) held_ = nanoseconds(0);
  if (!ahead) return;
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(passed - longest).count();
  jumps.push_back({"clock_set_ahead",
                   fmt::format("the machine's clock jumped ahead by {} s, to {}; nothing expires "
                               "until it has held for a day",
                               seconds, format_rfc3339({reading.ns}))});
}

/// Sets given_ns_.
void ForwardClock::follow(std::int64_t other_ns, Jumps& jumps) const {
  if (other_ns < std::exchange(seen_ns_, other_ns)) {
    set_back_ = SetBack{other_ns, given_ns_};
    const nanoseconds behind(given_ns_ - other_ns);
    if (behind >= kLeastJump) {
      jumps.push_back(
          {"clock_set_back",
           fmt::format("the machine's clock says {}, {} s before a time that was recorded: times "
                       "go on at half speed until it has caught up",
                       format_rfc3339({other_ns}),
                       std::chrono::duration_cast<std::chrono::seconds>(behind).count())});
    }
  }
  if (set_back_) {
    given_ns_ = set_back_->given_ns + (other_ns - set_back_->to_ns) / 2;
    if (other_ns >= given_ns_) set_back_.reset();
  }
  if (!set_back_) given_ns_ = other_ns;
}

void ForwardClock::report(const Jumps& jumps) const {
  for (const auto& [event, detail] : jumps) report_(event, detail);
}

}  // namespace fitgauge
