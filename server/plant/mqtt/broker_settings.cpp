#include "plant/mqtt/broker_settings.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace fitgauge::connections {
namespace {

using api::FieldReader;

constexpr std::string_view kPlain = "mqtt://";
constexpr std::string_view kTls = "mqtts://";
constexpr std::size_t kLongestText = 200;
constexpr std::size_t kLongestId = 100;

void read_address(FieldReader& fields, Broker& broker) {
  const auto text = fields.text("broker");
  if (!text) return;
  broker.tls = text->starts_with(kTls);
  const auto refuse = [&] {
    fields.report(ErrorCode::FieldInvalid, "broker",
                  "a broker is mqtts://host or mqtt://host, with a port behind it where it is "
                  "not 8883 or 1883; its user and password have members of their own");
  };
  if (!broker.tls && !text->starts_with(kPlain)) return refuse();
  std::string address = text->substr(broker.tls ? kTls.size() : kPlain.size());
  if (address.ends_with('/')) address.pop_back();
  const bool has_port = !address.ends_with(']') && address.find(':') != std::string::npos;
  if (!has_port) address += broker.tls ? ":8883" : ":1883";
  const auto parsed = control_link::parse_control_address(address);
  if (!parsed || address.find('@') != std::string::npos || address.size() > kLongestText) {
    return refuse();
  }
  broker.address = *parsed;
}

std::string short_text(std::string_view name, FieldReader& fields) {
  auto text = fields.optional_text(name).value_or("");
  if (text.size() > kLongestText || text.find('\0') != std::string::npos) {
    fields.report(ErrorCode::FieldInvalid, name,
                  fmt::format("{} has at most {} bytes", name, kLongestText));
  }
  return text;
}

void read_client_id(FieldReader& fields, Broker& broker) {
  const auto id = fields.optional_text("client_id");
  if (!id) return;
  const bool is_id =
      !id->empty() && id->size() <= kLongestId && std::all_of(id->begin(), id->end(), [](char c) {
        return c > ' ' && c < '\x7F' && c != '+' && c != '#';
      });
  if (!is_id) {
    fields.report(
        ErrorCode::FieldInvalid, "client_id",
        fmt::format("client_id has 1 to {} ASCII characters without blanks, + and #", kLongestId));
  }
  broker.client_id = *id;
}

}  // namespace

Broker read_broker(const FolderPermissions& allowed, FieldReader& fields) {
  Broker broker;
  read_address(fields, broker);
  broker.user = short_text("user", fields);
  broker.password = short_text("password", fields);
  if (!broker.password.empty() && broker.user.empty()) {
    fields.report(ErrorCode::FieldMissing, "user", "a password belongs to a user");
  }
  if (fields.has("ca_file")) {
    broker.ca_file = read_path("ca_file", allowed, fields);
    if (!broker.tls) {
      fields.report(ErrorCode::FieldInvalid, "ca_file",
                    "authorities vouch for a broker at mqtts:// alone");
    }
  }
  read_client_id(fields, broker);
  return broker;
}

Broker named(Broker broker, std::string_view origin, std::string_view connection) {
  if (broker.client_id.empty()) {
    broker.client_id = fmt::format("fitgauge-{}-{}", origin.substr(0, 8), connection);
  }
  return broker;
}

}  // namespace fitgauge::connections
