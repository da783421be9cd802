#include "service/state/connection_state.hpp"

#include <algorithm>

namespace fitgauge::app {

AttemptTurn note_attempt(ConnectionState& state, Timestamp now,
                         const std::optional<std::string>& why) {
  const bool was_failing = state.is_failing;
  state.last_attempt_at = now;
  ++state.attempts;
  state.is_failing = why.has_value();
  if (why) {
    ++state.failures;
    state.last_error = *why;
  } else {
    state.last_success_at = now;
  }
  if (was_failing == state.is_failing) return AttemptTurn::None;
  return why ? AttemptTurn::Failing : AttemptTurn::Recovered;
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

}  // namespace fitgauge::app
