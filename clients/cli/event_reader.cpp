#include "cli/event_reader.hpp"

namespace fitgauge::cli {

bool EventReader::feed(std::string_view piece) {
  for (;;) {
    const std::size_t end = piece.find('\n');
    line_ += piece.substr(0, end);
    if (end == std::string_view::npos) return true;
    piece.remove_prefix(end + 1);
    if (line_.ends_with('\r')) line_.pop_back();
    const bool goes_on = take_line(line_);
    line_.clear();
    if (!goes_on) return false;
  }
}

void EventReader::reconnect() {
  line_.clear();
  event_ = {};
}

bool EventReader::take_line(std::string_view line) {
  if (line.empty()) {
    const Event event = std::move(event_);
    event_ = {};
    if (!event.id.empty()) last_id_ = event.id;
    return event.data.empty() || sink_(event);
  }
  const std::size_t colon = line.find(':');
  const std::string_view name = line.substr(0, colon);
  std::string_view value = colon == std::string_view::npos ? "" : line.substr(colon + 1);
  if (value.starts_with(' ')) value.remove_prefix(1);
  if (name == "event") event_.type = value;
  if (name == "id") event_.id = value;
  if (name == "data") {
    if (!event_.data.empty()) event_.data += '\n';
    event_.data += value;
  }
  return true;  // a comment has no name
}

}  // namespace fitgauge::cli
