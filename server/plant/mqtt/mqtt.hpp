#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "plant/log_follower.hpp"
#include "plant/mqtt/broker_settings.hpp"
#include "plant/mqtt/topic_template.hpp"

namespace fitgauge::connections {

/// A broker that is told each measurement as a message.
struct MqttOptions {
  FollowerOptions follower{};
  Broker broker{};
  TopicTemplate topic{};
  std::string status_topic{};  ///< where `online` and the last will `offline` stand
  std::string events_topic{};  ///< above the type of an event that is no measurement
  bool retain = true;
};

/// Reads what the kind mqtt takes: that of a broker, `version`, `topic`, `status_topic`,
/// `events_topic`, `retain`, `filter`, `events`, `start`, `longest_wait_s`. What is wrong goes to
/// `errors`.
MqttOptions read_mqtt(std::string_view name, const FolderPermissions& allowed,
                      api::FieldReader& fields, api::FieldErrors& errors);

/// Publishes each measurement's record with QoS 1, in order and at most 32 ahead of the broker's
/// acknowledgements; a measurement is dealt with when its own has come, and those before it. What
/// the broker says it will never take (MQTT 5) is a dead letter. Stays connected between.
/// @param plant outlives it.
std::unique_ptr<Outlet> make_mqtt(const MqttOptions& options, const Plant& plant);

/// Connects under a client id of its own and says nothing.
ConnectionTest test_broker(const Broker& broker, std::string_view connection, const Plant& plant,
                           const std::stop_token& stop);

}  // namespace fitgauge::connections
