#include "plant/plant.hpp"

namespace fitgauge::connections {

void Worker::begin_attempt() {
  change([&](ConnectionState& state) {
    state.attempt_began_at = plant_.clock.now();
    state.attempt_began = std::chrono::steady_clock::now();
  });
}

void Worker::pass_refusal(const std::string& why, bool delivered) {
  change([&](ConnectionState& state) {
    state.attempt_began_at.reset();
    state.last_attempt_at = plant_.clock.now();
    ++state.attempts;
    ++state.failures;
    state.last_error = why;
    if (delivered) state.last_success_at = state.last_attempt_at;
  });
}

void Worker::finish_attempt(const std::optional<std::string>& why, bool delivered) {
  bool was_failing = false;
  change([&](ConnectionState& state) {
    was_failing = state.is_failing;
    state.attempt_began_at.reset();
    state.last_attempt_at = plant_.clock.now();
    ++state.attempts;
    state.is_failing = why.has_value();
    if (why) {
      ++state.failures;
      state.last_error = *why;
    }
    if (!why || delivered) state.last_success_at = state.last_attempt_at;
  });
  if (was_failing == why.has_value()) return;
  why ? plant_.tell("connection_failing", name_ + ": " + *why)
      : plant_.tell("connection_recovered", name_);
}

bool hangs(const ConnectionState& state, std::chrono::steady_clock::time_point now) {
  return state.attempt_began_at && now - state.attempt_began > kLongestStep;
}

std::optional<std::int64_t> lag(const ConnectionState& state, Timestamp now) {
  const auto since = [&](Timestamp then) {
    return std::max<std::int64_t>(now.nanoseconds - then.nanoseconds, 0);
  };
  if (!state.is_outgoing) {
    return state.last_success_at ? std::optional(since(*state.last_success_at)) : std::nullopt;
  }
  return state.waits_since ? since(*state.waits_since) : 0;
}

}  // namespace fitgauge::connections
