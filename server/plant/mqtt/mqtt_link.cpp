#include "plant/mqtt/mqtt_link.hpp"

#include <fmt/format.h>
#include <mosquitto.h>

#include <utility>

namespace fitgauge::connections {

std::string mqtt_reason(int reason) {
  if (reason == MqttClient::kCannotBeSent) return "the message cannot be sent as it is";
  return fmt::format("it answers: {}", mosquitto_reason_string(reason));
}

std::optional<std::string> MqttLink::connect(const std::stop_token& stop) {
  client_ = nullptr;  // the broker knows one of that name at a time
  client_ = std::make_unique<MqttClient>(broker_, will_, wake_);
  return client_->wait_connected(stop);
}

std::string MqttLink::give_up(std::string_view why) {
  const auto client = std::exchange(client_, nullptr);
  const bool is_lost = client == nullptr || !client->is_connected();
  if (is_lost) return client == nullptr ? std::string(why) : client->failure();
  return fmt::format("the broker {}: {}", to_text(broker_.address), why);
}

}  // namespace fitgauge::connections
