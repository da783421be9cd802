#include "app/service/connection_state.hpp"

#include <algorithm>

namespace fitgauge::app {

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
