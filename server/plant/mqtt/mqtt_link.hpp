#pragma once

#include "plant/mqtt/mqtt_client.hpp"
#include "plant/plant.hpp"
#include "plant/settings.hpp"
#include "record/measurement.hpp"

namespace fitgauge::connections {

/// Returns a text as one level of a topic, or a part of one. `% + # /`, control characters and
/// characters that MQTT forbids (1.5.4) become `%XX` of their bytes. Different texts stay
/// different. An empty text is `-`, a text `-` is `%2D`.
std::string topic_level(std::string_view text);

/// A topic with the texts of a measurement in it: `plant/{machine}/{characteristic}`.
class TopicTemplate {
 public:
  /// @errors FieldInvalid: no topic, an unknown name, a `{` without its end.
  static Result<TopicTemplate> parse(std::string_view text);
  /// Reads one level after others: without `/`; it may begin with a name.
  static Result<TopicTemplate> parse_level(std::string_view text) {
    if (text.find('/') != std::string_view::npos)
      return invalid_field("one level of a topic must not have /");
    return parse_parts(text);
  }

  /// A text that the measurement lacks is `-`. @returns at most 65,535 bytes: the fields are short.
  std::string topic_of(const app::Measurement& measurement) const;

 private:
  struct Part {
    bool is_name = false;
    std::string text{};
  };
  static Result<TopicTemplate> parse_parts(std::string_view text);

  std::vector<Part> parts_;
};

/// Longest silence of a broker after a request.
inline constexpr std::chrono::seconds kLongestSilence{20};

/// The meaning of a broker's reason code, or of the library's error for a message.
std::string mqtt_reason(int reason);

/// The client of an outlet: a new one for each connection. For one thread.
class MqttLink {
 public:
  explicit MqttLink(Broker broker, std::optional<MqttMessage> will = {})
      : broker_(std::move(broker)), will_(std::move(will)) {}

  void wake_by(std::function<void()> wake) { wake_ = std::move(wake); }
  /// Takes effect at the next connection.
  void set_will(MqttMessage will) { will_ = std::move(will); }
  bool is_up() const { return client_ && client_->is_connected(); }
  /// Connects anew and waits until the broker has accepted. @returns the reason for a failure.
  std::optional<std::string> connect(const std::stop_token& stop) {
    client_ = nullptr;  // the broker allows one client of that name
    client_ = std::make_unique<MqttClient>(broker_, will_, wake_);
    return client_->wait_connected(stop);
  }
  /// Ends the connection; the broker publishes the will.
  /// @returns why it was lost or, if it was not, `why` with the broker's name.
  std::string give_up(std::string_view why);
  /// Ends the connection after a refusal, after which the broker may have ended it too.
  /// @returns `why` with the broker's name.
  std::string refused(std::string_view why) {
    client_ = nullptr;
    return fmt::format("the broker {}: {}", to_text(broker_.address), why);
  }
  /// @pre connect succeeded
  MqttClient& client() { return *client_; }

 private:
  const Broker broker_;
  std::optional<MqttMessage> will_;
  std::function<void()> wake_ = [] {};
  std::unique_ptr<MqttClient> client_;
};

inline constexpr std::size_t kLongestBrokerText = 200;
inline constexpr std::size_t kLongestClientId = 100;  ///< of a client

/// The address of mqtt://host:1883 or mqtts://host:8883. @errors FieldInvalid
Result<Broker> read_broker(std::string_view text);
/// @errors FieldInvalid
Result<std::string> read_client_id(std::string_view id);

/// The form of a user or a password.
inline auto short_text(std::string_view name) {
  return By{kLongestBrokerText, [name](std::string_view text) -> Result<std::string> {
              if (text.size() <= kLongestBrokerText && text.find('\0') == text.npos)
                return std::string(text);
              return invalid_field(
                  fmt::format("{} must have at most {} bytes", name, kLongestBrokerText));
            }};
}

/// Describes the settings of every connection to a broker. An absent `client_id` is empty.
template <class V>
void broker_members(V& v, Broker& broker) {
  v.member("broker", broker, By{kLongestBrokerText, read_broker},
           "mqtts://host or mqtt://host, with :port");
  v.optional("user", broker.user, short_text("user"), "Client id of the service at the broker");
  v.optional(
      "ca_file", broker.ca_file, path_for(v),
      "File of authorities for the broker's certificate (default: the system's authorities)");
  v.optional("client_id", broker.client_id, By{kLongestClientId, read_client_id},
             "Name at the broker (default: fitgauge-, digits of the data folder and the name)");
  v.optional("password", broker.password, short_text("password"),
             "Password (default: the stored one, if broker, user and ca_file are unchanged)");
  v.check([&](api::FieldReader& fields) {
    if (!broker.password.empty() && broker.user.empty()) {
      fields.report(ErrorCode::FieldMissing, "user", "password needs user");
    }
    if (fields.has("ca_file") && !broker.tls) {
      fields.report(ErrorCode::FieldInvalid, "ca_file", "ca_file needs a broker at mqtts://");
    }
  });
}

/// The broker with a client id: the default is the same at each start, and unique to this data
/// folder and connection. @param origin of the data folder: 16 hexadecimal digits.
Broker named(Broker broker, std::string_view origin, std::string_view connection);

/// Connects under a separate client id without sending.
TestResult test_broker(const Broker& broker, std::string_view connection, const Plant& plant,
                       const std::stop_token& stop);

}  // namespace fitgauge::connections
