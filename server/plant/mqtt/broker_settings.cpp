#include "plant/mqtt/broker_settings.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace fitgauge::connections {
namespace {

constexpr std::string_view kPlain = "mqtt://";
constexpr std::string_view kTls = "mqtts://";

}  // namespace

Result<Broker> read_broker(std::string_view text) {
  Broker broker;
  broker.tls = text.starts_with(kTls);
  const auto refused = invalid_field(
      "a broker is mqtts://host or mqtt://host, with a port behind it where it is not 8883 or "
      "1883; its user and password have members of their own");
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
      !id.empty() && id.size() <= kLongestClientId && std::all_of(id.begin(), id.end(), [](char c) {
        return c > ' ' && c < '\x7F' && c != '+' && c != '#';
      });
  if (is_id) return std::string(id);
  return invalid_field(fmt::format("client_id has 1 to {} ASCII characters without blanks, + and #",
                                   kLongestClientId));
}

Broker named(Broker broker, std::string_view origin, std::string_view connection) {
  if (broker.client_id.empty()) {
    broker.client_id = fmt::format("fitgauge-{}-{}", origin.substr(0, 8), connection);
  }
  return broker;
}

ConnectionTest test_broker(const Broker& broker, std::string_view connection, const Plant& plant,
                           const std::stop_token& stop) {
  Broker probe = named(broker, plant.origin, connection);
  probe.client_id += "-test";  // the broker would send the connection itself away
  MqttClient client(probe, {}, [] {});
  if (auto failure = client.wait_connected(stop)) return {.ok = false, .detail = *failure};
  client.leave();
  return {.ok = true, .detail = "the broker accepts the connection"};
}

}  // namespace fitgauge::connections
