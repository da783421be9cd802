#pragma once

#include <list>

#include "base/clock.hpp"
#include "plant/log_follower.hpp"
#include "plant/mqtt/mqtt_client.hpp"
#include "plant/mqtt/mqtt_link.hpp"
#include "record/measurement.hpp"

namespace fitgauge::connections {

/// An edge node of Sparkplug B, version 3.0 of the specification, over MQTT 3.1.1.
struct SparkplugOptions {
  FollowerOptions follower{};
  Broker broker{};
  std::string group{};
  std::string node{};
  /// Names the device of a measurement; a device shows its newest one.
  TopicTemplate device = TopicTemplate::parse_level("{machine}:{characteristic}").value();
  std::string primary_host{};  ///< nothing is sent while this host is offline; empty: no host
  std::size_t most_devices = 1000;
};

/// The types of the specification that we send (3.0, 6.4.16 "Data Types").
enum class SparkplugType : std::uint32_t {
  Int64 = 4,
  Double = 10,
  Boolean = 11,
  String = 12,
  DateTime = 13
};

/// Null, truth, whole number (of DateTime in milliseconds), number, text.
using SparkplugValue = std::variant<std::monostate, bool, std::int64_t, double, std::string>;

struct SparkplugMetric {
  std::string name{};                    ///< in births and deaths; otherwise empty
  std::optional<std::uint64_t> alias{};  ///< replaces the name in data
  std::optional<SparkplugType> type{};   ///< in births and deaths
  Timestamp at{};
  SparkplugValue value{};
};

/// Milliseconds since 1970; earlier times are 0, because the payload has no sign for times.
std::int64_t milliseconds(Timestamp time);

/// The bytes of a payload. @param seq none in a death of the node.
std::string sparkplug_payload(Timestamp sent_at, std::optional<std::uint8_t> seq,
                              const std::vector<SparkplugMetric>& metrics);

inline constexpr std::string_view kRebirth = "Node Control/Rebirth";

/// Whether a command requests all births. A malformed payload requests nothing.
bool asks_for_rebirth(std::string_view payload);

/// Messages of an edge node, with their order and numbers. Sends nothing itself. For one thread.
class EdgeNode {
 public:
  using Send = std::function<void(MqttMessage)>;

  /// @param send receives the messages in their order; it and `clock` must outlive this.
  EdgeNode(const SparkplugOptions& options, const Clock& clock, Send send);

  /// A session, numbered as its CONNECT is: 0 to 255.
  void begin_session(std::uint8_t number) { session_ = number; }
  /// The message that the broker publishes if the session breaks, and the node before it ends one.
  MqttMessage death() const;
  /// The births of the node and of all its devices.
  void give_birth();
  /// Adds data of the measurement's device, with a birth if it is new. If there are too many
  /// devices, the longest silent one dies. @pre give_birth
  void tell(const app::Measurement& measurement);
  /// Number of measurements of the log to report. @pre give_birth
  void tell_position(std::int64_t position);

  std::string topic(std::string_view type, std::string_view device = {}) const {
    return fmt::format("spBv1.0/{}/{}/{}{}{}", options_.group, type, options_.node,
                       device.empty() ? "" : "/", device);
  }

 private:
  struct Device {
    std::string id{};
    std::vector<SparkplugMetric> metrics{};  ///< as last reported
  };
  using Devices = std::list<Device>;  ///< the longest silent device first

  void send(std::string_view type, std::string_view device,
            const std::vector<SparkplugMetric>& metrics);
  void send_birth(const Device& device) { send("DBIRTH", device.id, device.metrics); }
  SparkplugMetric session_metric() const;
  /// @param metrics with names and types, for the birth of a new device
  Device& device_of(const std::string& id, std::vector<SparkplugMetric> metrics);

  const SparkplugOptions& options_;
  const Clock& clock_;
  const Send send_;
  std::uint8_t session_ = 0;
  std::uint8_t seq_ = 0;       ///< of the next message
  SparkplugValue position_{};  ///< null before the first
  std::uint64_t next_alias_;
  Devices devices_;
  std::map<std::string, Devices::iterator> by_id_;
};

/// State of the primary host, from the received STATE messages.
class HostState {
 public:
  /// Reads a STATE message. An older one, or another payload, changes nothing.
  void take(std::string_view payload);
  /// Begins a new connection: everything is sent to the broker again.
  void forget() { is_online_ = false; }
  bool is_online() const { return is_online_; }

 private:
  bool is_online_ = false;
  std::optional<std::int64_t> timestamp_{};
};

}  // namespace fitgauge::connections
