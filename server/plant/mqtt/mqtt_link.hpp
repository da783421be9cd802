#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>

#include "plant/mqtt/mqtt_client.hpp"

namespace fitgauge::connections {

/// Of a broker that is asked for an answer.
inline constexpr std::chrono::seconds kLongestSilence{20};

/// What a broker says by a reason code, or the library of a message it does not send.
std::string mqtt_reason(int reason);

/// The client of an outlet: a new one for each connection. For one thread.
class MqttLink {
 public:
  explicit MqttLink(Broker broker, std::optional<MqttMessage> will = {})
      : broker_(std::move(broker)), will_(std::move(will)) {}

  void wake_by(std::function<void()> wake) { wake_ = std::move(wake); }
  /// The broker is told at the next connection.
  void set_will(MqttMessage will) { will_ = std::move(will); }
  bool is_up() const { return client_ && client_->is_connected(); }
  /// Begins anew and waits until the broker has accepted. @returns why it has not.
  std::optional<std::string> connect(const std::stop_token& stop);
  /// Ends the connection; the broker publishes the will.
  /// @returns why it was lost or, where it is not, `why` with the broker's name.
  std::string give_up(std::string_view why);
  /// @pre connect went well
  MqttClient& client() { return *client_; }

 private:
  const Broker broker_;
  std::optional<MqttMessage> will_;
  std::function<void()> wake_ = [] {};
  std::unique_ptr<MqttClient> client_;
};

}  // namespace fitgauge::connections
