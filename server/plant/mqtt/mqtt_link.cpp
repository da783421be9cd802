#include "plant/mqtt/mqtt_link.hpp"

#include <mosquitto.h>

namespace fitgauge::connections {
namespace {

using app::Measurement;

constexpr std::size_t kLongest = 500;

/// A name that a topic may have, and its text.
using NamedText = std::pair<std::string_view, std::string_view>;

std::vector<NamedText> texts_of(const Measurement& measurement) {
  std::vector<NamedText> texts;
  for (const app::MeasurementField& field : app::kLabels) {
    if (field.name == "comment") continue;
    texts.emplace_back(field.name, (measurement.*field.text).value_or(""));
  }
  texts.emplace_back("verdict", word(measurement.result.verdict));
  texts.emplace_back("source", word(measurement.source));
  texts.emplace_back("tolerance_class", measurement.class_name.value_or(""));
  texts.emplace_back("caller", measurement.caller.value_or(""));
  return texts;
}

/// Returns whether a topic or a level may not have the character, as MQTT 1.5.4 advises.
bool is_escaped(char32_t c) {
  return c == U'%' || c == U'+' || c == U'#' || c == U'/' || c < 0x20 || (c >= 0x7F && c < 0xA0) ||
         (c >= 0xFDD0 && c <= 0xFDEF) || (c & 0xFFFE) == 0xFFFE;
}

/// Whether a template may have all these characters as they are.
bool is_literal(std::string_view text) {
  while (!text.empty()) {
    const char32_t c = take_character(text);
    const bool is_kept = c != U'}' && (c == U'/' || c == U'%' || !is_escaped(c));
    if (!is_kept) return false;
  }
  return true;
}

constexpr std::string_view kPlain = "mqtt://";
constexpr std::string_view kTls = "mqtts://";

}  // namespace

std::string topic_level(std::string_view text) {
  if (text.empty()) return "-";
  if (text == "-") return "%2D";
  std::string level;
  while (!text.empty()) {
    std::string_view bytes = text;
    const char32_t c = take_character(text);
    bytes.remove_suffix(text.size());
    if (!is_escaped(c)) {
      level += bytes;
      continue;
    }
    for (const char byte : bytes) level += fmt::format("%{:02X}", static_cast<unsigned char>(byte));
  }
  return level;
}

Result<TopicTemplate> TopicTemplate::parse(std::string_view text) {
  // The broker keeps $ for itself; a text that begins with one must not get there.
  if (text.starts_with('$') || text.starts_with('{')) {
    return invalid_field("a topic must begin with your own word, such as plant/");
  }
  return parse_parts(text);
}

Result<TopicTemplate> TopicTemplate::parse_parts(std::string_view text) {
  if (text.empty() || text.size() > kLongest) {
    return invalid_field(fmt::format("a topic must have 1 to {} bytes", kLongest));
  }
  TopicTemplate made;
  const std::vector<NamedText> known = texts_of({});
  while (!text.empty()) {
    const std::size_t open = text.find('{');
    const std::string_view literal = text.substr(0, open);
    if (!is_literal(literal))
      return invalid_field("a topic must not have +, #, } or control characters");
    made.parts_.push_back({.text = std::string(literal)});
    if (open == std::string_view::npos) break;
    text.remove_prefix(open + 1);
    const std::size_t close = text.find('}');
    const std::string_view name = text.substr(0, close);
    const bool is_known = std::ranges::find(known, name, &NamedText::first) != known.end();
    if (close == std::string_view::npos || !is_known) {
      std::vector<std::string> names;
      for (const auto& [each, value] : known) names.push_back(fmt::format("{{{}}}", each));
      return invalid_field(fmt::format("unknown {{{}}}; use one of: {}", first_characters(name, 40),
                                       fmt::join(names, ", ")));
    }
    made.parts_.push_back({.is_name = true, .text = std::string(name)});
    text.remove_prefix(close + 1);
  }
  return made;
}

std::string TopicTemplate::topic_of(const Measurement& measurement) const {
  const std::vector<NamedText> texts = texts_of(measurement);
  std::string topic;
  for (const Part& part : parts_) {
    topic += part.is_name
                 ? topic_level(std::ranges::find(texts, part.text, &NamedText::first)->second)
                 : part.text;
  }
  return topic;
}

std::string mqtt_reason(int reason) {
  if (reason == MqttClient::kCannotBeSent) return "the message cannot be sent as it is";
  return fmt::format("it answers: {}", mosquitto_reason_string(reason));
}

std::string MqttLink::give_up(std::string_view why) {
  const auto client = std::exchange(client_, nullptr);
  const bool is_lost = client == nullptr || !client->is_connected();
  if (is_lost) return client == nullptr ? std::string(why) : client->failure();
  return refused(why);
}

Result<Broker> read_broker(std::string_view text) {
  Broker broker;
  broker.tls = text.starts_with(kTls);
  const auto refused = invalid_field(
      "broker must be mqtts://host or mqtt://host, with :port if it is not 8883 or 1883; user and "
      "password are separate members");
  if (!broker.tls && !text.starts_with(kPlain)) return refused;
  std::string address(text.substr(broker.tls ? kTls.size() : kPlain.size()));
  if (address.ends_with('/')) address.pop_back();
  const bool has_port = !address.ends_with(']') && address.find(':') != std::string::npos;
  if (!has_port) address += broker.tls ? ":8883" : ":1883";
  const auto parsed = control_link::parse_control_address(address);
  if (!parsed || address.find('@') != std::string::npos || address.size() > kLongestBrokerText) {
    return refused;
  }
  broker.address = *parsed;
  return broker;
}

Result<std::string> read_client_id(std::string_view id) {
  const bool is_id =
      !id.empty() && id.size() <= kLongestClientId &&
      std::ranges::all_of(id, [](char c) { return c > ' ' && c < '\x7F' && c != '+' && c != '#'; });
  if (is_id) return std::string(id);
  return invalid_field(fmt::format(
      "client_id must have 1 to {} ASCII characters without blanks, + and #", kLongestClientId));
}

Broker named(Broker broker, std::string_view origin, std::string_view connection) {
  if (broker.client_id.empty()) {
    broker.client_id = fmt::format("fitgauge-{}-{}", origin.substr(0, 8), connection);
  }
  return broker;
}

TestResult test_broker(const Broker& broker, std::string_view connection, const Plant& plant,
                       const std::stop_token& stop) {
  Broker probe = named(broker, plant.origin, connection);
  probe.client_id += "-test";  // the broker would send the connection itself away
  MqttClient client(probe, {}, [] {});
  if (auto failure = client.wait_connected(stop)) return Error{ErrorCode::NotReady, *failure};
  client.leave();
  return "the broker accepts the connection";
}

}  // namespace fitgauge::connections
