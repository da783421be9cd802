#include <fmt/format.h>

#include "plant/sparkplug/sparkplug.hpp"

namespace fitgauge::connections {
namespace {

using api::FieldReader;

constexpr std::size_t kLongestId = 200;
constexpr std::string_view kDevice = "{machine}:{characteristic}";

/// The id of a group, a node or a host: one level of a topic that needs no escapes.
std::string read_id(std::string_view name, std::string id, FieldReader& fields) {
  const bool is_id = !id.empty() && id.size() <= kLongestId && id.find('%') == id.npos &&
                     id != "-" && topic_level(id) == id;
  if (!is_id) {
    fields.report(ErrorCode::FieldInvalid, name,
                  fmt::format("{} has 1 to {} bytes without + # / % and control characters", name,
                              kLongestId));
  }
  return id;
}

}  // namespace

SparkplugOptions read_sparkplug(std::string_view name, const FolderPermissions& allowed,
                                FieldReader& fields, api::FieldErrors& errors) {
  SparkplugOptions options;
  options.follower.name = name;
  options.broker = read_broker(allowed, fields);
  if (const auto group = fields.text("group")) {
    options.group = read_id("group", *group, fields);
    if (*group == "STATE") {
      fields.report(ErrorCode::FieldInvalid, "group", "STATE is the place of the hosts");
    }
  }
  if (const auto node = fields.text("node")) options.node = read_id("node", *node, fields);
  if (const auto host = fields.optional_text("primary_host")) {
    options.primary_host = read_id("primary_host", *host, fields);
  }
  const std::string text = fields.optional_text("device").value_or(std::string(kDevice));
  auto device = TopicTemplate::parse_level(text);
  if (device) {
    options.device = *std::move(device);
  } else {
    fields.report(ErrorCode::FieldInvalid, "device", device.error().message);
  }
  options.most_devices = static_cast<std::size_t>(fields.integer_or("most_devices", 1000, 1, 1000));
  read_follower(fields, errors, options.follower);
  return options;
}

}  // namespace fitgauge::connections
