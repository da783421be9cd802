#pragma once

#include <cstddef>
#include <string>

#include "plant/log_follower.hpp"
#include "plant/mqtt/broker_settings.hpp"
#include "plant/mqtt/topic_template.hpp"

namespace fitgauge::connections {

/// An edge node of Sparkplug B, version 3.0 of the specification, over MQTT 3.1.1.
struct SparkplugOptions {
  FollowerOptions follower{};
  Broker broker{};
  std::string group{};
  std::string node{};
  /// Whose last measurement a device shows.
  TopicTemplate device = TopicTemplate::parse_level("{machine}:{characteristic}").value();
  std::string
      primary_host{};  ///< nothing goes out while it is offline; empty: nobody is waited for
  std::size_t most_devices = 1000;
};

}  // namespace fitgauge::connections
