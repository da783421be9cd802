#pragma once

#include <cstdint>
#include <functional>
#include <list>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "base/clock.hpp"
#include "plant/mqtt/mqtt_client.hpp"
#include "plant/sparkplug/device_metrics.hpp"
#include "plant/sparkplug/sparkplug.hpp"

namespace fitgauge::connections {

/// The messages of an edge node: which, in which order, with which numbers. Sends nothing itself.
/// For one thread.
class EdgeNode {
 public:
  using Send = std::function<void(MqttMessage)>;

  /// @param send takes the messages in their order; outlives it, as `clock` does.
  EdgeNode(const SparkplugOptions& options, const Clock& clock, Send send);

  /// A session, numbered as its CONNECT is: 0 to 255.
  void begin_session(std::uint8_t number);
  /// What the broker publishes when the session is cut off, and the node before it ends one.
  MqttMessage death() const;
  /// The births of the node and of all its devices.
  void give_birth();
  /// Data of the measurement's device, which is born first if it is new; the device that was silent
  /// longest dies where there would be too many. @pre give_birth
  void tell(const app::Measurement& measurement);
  /// How many measurements of the log are told. @pre give_birth
  void tell_position(std::int64_t position);

  std::string topic(std::string_view type, std::string_view device = {}) const;

 private:
  struct Device {
    std::string id{};
    std::uint64_t first_alias = 0;
    std::vector<SparkplugMetric> metrics{};  ///< as they were last told
  };
  using Devices = std::list<Device>;  ///< the one that was silent longest first

  void send(std::string_view type, std::string_view device,
            const std::vector<SparkplugMetric>& metrics);
  void send_birth(const Device& device);
  SparkplugMetric session_metric() const;
  Device& device_of(const std::string& id);

  const SparkplugOptions& options_;
  const Clock& clock_;
  const Send send_;
  std::uint8_t session_ = 0;
  std::uint8_t seq_ = 0;       ///< of the next message
  SparkplugValue position_{};  ///< null until one is told
  std::uint64_t next_alias_;
  Devices devices_;
  std::map<std::string, Devices::iterator> by_id_;
};

}  // namespace fitgauge::connections
