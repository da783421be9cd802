#include "plant/plant.hpp"

#include <algorithm>

namespace fitgauge::connections {

void Worker::finish_attempt(const std::optional<std::string>& why) {
  bool was_failing = false;
  change([&](ConnectionState& state) {
    was_failing = state.is_failing;
    state.last_attempt_at = plant_.clock.now();
    ++state.attempts;
    state.is_failing = why.has_value();
    if (why) {
      ++state.failures;
      state.last_error = *why;
    } else {
      state.last_success_at = state.last_attempt_at;
    }
  });
  if (was_failing == why.has_value()) return;
  why ? plant_.tell("connection_failing", name_ + ": " + *why)
      : plant_.tell("connection_recovered", name_);
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
