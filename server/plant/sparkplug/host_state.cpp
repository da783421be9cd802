#include "plant/sparkplug/host_state.hpp"

#include <charconv>

#include "base/json/json_value.hpp"

namespace fitgauge::connections {

void HostState::take(std::string_view payload) {
  const auto state = parse_json(payload);
  if (!state || !state->is(JsonValue::Kind::Object)) return;
  const JsonValue* const online = state->find("online");
  const JsonValue* const time = state->find("timestamp");
  const bool is_whole = online != nullptr && online->is(JsonValue::Kind::Boolean) &&
                        time != nullptr && time->is(JsonValue::Kind::Number);
  if (!is_whole) return;
  std::int64_t timestamp = 0;
  const char* const end = time->text.data() + time->text.size();
  const auto read = std::from_chars(time->text.data(), end, timestamp);
  if (read.ec != std::errc() || read.ptr != end) return;
  if (timestamp_ && timestamp < *timestamp_) return;
  timestamp_ = timestamp;
  is_online_ = online->boolean;
}

}  // namespace fitgauge::connections
