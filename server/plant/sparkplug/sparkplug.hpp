#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

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
  TopicTemplate device{};  ///< whose last measurement a device shows
  std::string
      primary_host{};  ///< nothing goes out while it is offline; empty: nobody is waited for
  std::size_t most_devices = 1000;
};

/// Reads what the kind sparkplug takes: that of a broker but `version`, `group`, `node`, `device`,
/// `primary_host`, `most_devices`, `filter`, `start`, `longest_wait_s`. What is wrong goes to
/// `errors`.
SparkplugOptions read_sparkplug(std::string_view name, const FolderPermissions& allowed,
                                api::FieldReader& fields, api::FieldErrors& errors);

/// Each measurement is the data of a device. Data has QoS 0, as the specification wants it, so a
/// measurement is dealt with when the broker has answered a question that came behind it: it takes
/// the packets of a connection in their order. @param plant outlives it.
std::unique_ptr<Outlet> make_sparkplug(const SparkplugOptions& options, const Plant& plant);

}  // namespace fitgauge::connections
