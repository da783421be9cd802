#include "plant/mqtt/topic_template.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "base/text.hpp"

namespace fitgauge::connections {
namespace {

using app::Measurement;

constexpr std::size_t kLongest = 500;

/// What a topic can have beside the texts of a measurement.
struct OtherName {
  std::string_view name;
  std::string (*of)(const Measurement& measurement);
};
constexpr OtherName kOtherNames[] = {
    {"verdict", [](const Measurement& m) { return std::string(word(m.result.verdict)); }},
    {"source", [](const Measurement& m) { return std::string(word(m.source)); }},
    {"tolerance_class",
     [](const Measurement& m) { return std::string(m.class_name.value_or("")); }},
    {"caller", [](const Measurement& m) { return std::string(m.caller.value_or("")); }},
};

std::optional<std::string> value_of(const Measurement& measurement, std::string_view name) {
  for (const app::MeasurementField& field : app::kLabels) {
    if (field.name == name && name != "comment")
      return std::string((measurement.*field.text).value_or(""));
  }
  for (const OtherName& other : kOtherNames) {
    if (other.name == name) return other.of(measurement);
  }
  return std::nullopt;
}

std::string names() {
  std::string all;
  for (const app::MeasurementField& field : app::kLabels) {
    if (field.name != "comment") all += fmt::format("{{{}}}, ", field.name);
  }
  for (const OtherName& other : kOtherNames) all += fmt::format("{{{}}}, ", other.name);
  all.resize(all.size() - 2);
  return all;
}

/// Whether a topic may not have the character, or a level may not: what MQTT 1.5.4 advises against.
bool is_escaped(char32_t c) {
  return c == U'%' || c == U'+' || c == U'#' || c == U'/' || c < 0x20 || (c >= 0x7F && c < 0xA0) ||
         (c >= 0xFDD0 && c <= 0xFDEF) || (c & 0xFFFE) == 0xFFFE;
}

/// The character at the front of valid UTF-8, and how many bytes it takes.
std::pair<char32_t, std::size_t> front_character(std::string_view text) {
  const auto first = static_cast<unsigned char>(text.front());
  const std::size_t size = first < 0x80 ? 1U : first < 0xE0 ? 2U : first < 0xF0 ? 3U : 4U;
  char32_t c = size == 1 ? first : first & (0xFFU >> (size + 1));
  for (std::size_t i = 1; i < size && i < text.size(); ++i) {
    c = c << 6U | (static_cast<unsigned char>(text[i]) & 0x3FU);
  }
  return {c, std::min(size, text.size())};
}

Error invalid(std::string message) { return {ErrorCode::FieldInvalid, std::move(message)}; }

/// What may stand in a template as it is.
bool is_literal(std::string_view text) {
  while (!text.empty()) {
    const auto [c, size] = front_character(text);
    const bool is_kept = c != U'}' && (c == U'/' || c == U'%' || !is_escaped(c));
    if (!is_kept) return false;
    text.remove_prefix(size);
  }
  return true;
}

}  // namespace

std::string topic_level(std::string_view text) {
  if (text.empty()) return "-";
  if (text == "-") return "%2D";
  std::string level;
  while (!text.empty()) {
    const auto [c, size] = front_character(text);
    for (const char byte : text.substr(0, size)) {
      if (is_escaped(c)) {
        level += fmt::format("%{:02X}", static_cast<unsigned char>(byte));
      } else {
        level += byte;
      }
    }
    text.remove_prefix(size);
  }
  return level;
}

Result<TopicTemplate> TopicTemplate::parse(std::string_view text) {
  // The broker keeps $ for itself; a text that begins with one must not get there.
  if (text.starts_with('$') || text.starts_with('{')) {
    return invalid("a topic begins with a word of your own, such as plant/");
  }
  return parse_parts(text);
}

Result<TopicTemplate> TopicTemplate::parse_level(std::string_view text) {
  if (text.find('/') != std::string_view::npos) return invalid("one level of a topic has no /");
  return parse_parts(text);
}

Result<TopicTemplate> TopicTemplate::parse_parts(std::string_view text) {
  if (text.empty() || text.size() > kLongest) {
    return invalid(fmt::format("a topic has 1 to {} bytes", kLongest));
  }
  TopicTemplate made;
  while (!text.empty()) {
    const std::size_t open = text.find('{');
    const std::string_view literal = text.substr(0, open);
    if (!is_literal(literal)) return invalid("a topic has no +, #, } and control characters");
    made.parts_.push_back({.text = std::string(literal)});
    if (open == std::string_view::npos) break;
    text.remove_prefix(open + 1);
    const std::size_t close = text.find('}');
    const std::string_view name = text.substr(0, close);
    if (close == std::string_view::npos || !value_of({}, name)) {
      return invalid(
          fmt::format("there is no {{{}}}: take {}", first_characters(name, 40), names()));
    }
    made.parts_.push_back({.is_name = true, .text = std::string(name)});
    text.remove_prefix(close + 1);
  }
  return made;
}

std::string TopicTemplate::topic_of(const Measurement& measurement) const {
  std::string topic;
  for (const Part& part : parts_) {
    topic += part.is_name ? topic_level(*value_of(measurement, part.text)) : part.text;
  }
  return topic;
}

}  // namespace fitgauge::connections
