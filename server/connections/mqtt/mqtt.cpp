#include "connections/mqtt/mqtt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "app/measurements/record.hpp"
#include "connections/mqtt/mqtt_link.hpp"

namespace fitgauge::connections {
namespace {

constexpr std::size_t kMostAhead = 32;
/// So that how far it came is kept soon.
constexpr std::chrono::milliseconds kLongestStretch{500};
/// Without any acknowledgement.
constexpr std::chrono::seconds kLongestSilence{20};
constexpr std::size_t kLongestTopic = 500;

/// What a reason code of MQTT 5 says of the message alone (5.0, 3.4.2.1).
bool is_of_the_message(int reason) {
  constexpr int kTopicNameInvalid = 0x90;
  constexpr int kPayloadFormatInvalid = 0x99;
  return reason == kTopicNameInvalid || reason == kPayloadFormatInvalid ||
         reason == MqttClient::kCannotBeSent;
}

class Mqtt final : public Outlet {
 public:
  Mqtt(const MqttOptions& options, const Surroundings& around)
      : around_(around),
        options_(options),
        link_(options.broker,
              MqttMessage{.topic = options.status_topic, .payload = "offline", .retain = true}) {}
  ~Mqtt() override;

  void wake_by(std::function<void()> wake) override { link_.wake_by(std::move(wake)); }
  Delivery deliver(std::span<const Outgoing> measurements, const std::stop_token& stop) override;
  std::optional<Delivery> idle(const std::stop_token& stop) override;

 private:
  std::optional<std::string> connect(const std::stop_token& stop);
  MqttClient::Ticket publish(const app::Measurement& measurement);

  const Surroundings& around_;
  const MqttOptions options_;
  MqttLink link_;
};

std::optional<std::string> Mqtt::connect(const std::stop_token& stop) {
  if (link_.is_up()) return std::nullopt;
  if (auto failure = link_.connect(stop)) return failure;
  link_.client().publish({.topic = options_.status_topic, .payload = "online", .retain = true});
  return std::nullopt;
}

std::optional<Delivery> Mqtt::idle(const std::stop_token& stop) {
  if (link_.is_up()) return std::nullopt;
  return Delivery{.failure = connect(stop)};
}

MqttClient::Ticket Mqtt::publish(const app::Measurement& measurement) {
  MqttMessage message{.topic = options_.topic.topic_of(measurement), .retain = options_.retain};
  app::append_record(message.payload, measurement);
  return link_.client().publish(std::move(message));
}

Delivery Mqtt::deliver(std::span<const Outgoing> measurements, const std::stop_token& stop) {
  Delivery delivery{.failure = connect(stop)};
  if (delivery.failure) return delivery;
  const auto until = std::chrono::steady_clock::now() + kLongestStretch;
  std::deque<MqttClient::Ticket> ahead;
  std::size_t sent = 0;
  while (true) {
    const bool sends_more = std::chrono::steady_clock::now() < until && !stop.stop_requested();
    while (sends_more && sent < measurements.size() && ahead.size() < kMostAhead) {
      ahead.push_back(publish(**measurements[sent++]));
    }
    if (ahead.empty()) return delivery;
    const auto reason = link_.client().wait_settled(ahead.front(), kLongestSilence, stop);
    if (!reason || (*reason != 0 && !is_of_the_message(*reason))) {
      if (stop.stop_requested()) return delivery;
      // What is on its way comes again over a new connection: a broker that is out of step ends.
      delivery.failure =
          link_.give_up(reason ? mqtt_reason(*reason) : "it does not acknowledge what it is sent");
      return delivery;
    }
    if (*reason != 0) {
      const app::Measurement& refused = **measurements[delivery.dealt_with];
      delivery.refused.push_back(
          {.measurement = app::measurement_id_text(refused.id, refused.origin),
           .reason = mqtt_reason(*reason),
           .at = around_.clock.now()});
    }
    ahead.pop_front();
    ++delivery.dealt_with;
  }
}

Mqtt::~Mqtt() {
  if (!link_.is_up()) return;
  link_.client().publish({.topic = options_.status_topic, .payload = "offline", .retain = true});
  link_.client().leave();
}

}  // namespace

MqttOptions read_mqtt(std::string_view name, const FolderPermissions& allowed,
                      api::FieldReader& fields, api::FieldErrors& errors) {
  MqttOptions options;
  options.follower.name = name;
  options.broker = read_broker(allowed, fields);
  const auto version = fields.optional_text("version");
  options.broker.version_5 = version == "5";
  if (version && *version != "5" && *version != "3.1.1") {
    fields.report(ErrorCode::FieldInvalid, "version", "version is 3.1.1 or 5");
  }
  if (const auto text = fields.text("topic")) {
    auto topic = TopicTemplate::parse(*text);
    if (topic) {
      options.topic = *std::move(topic);
    } else {
      fields.report(ErrorCode::FieldInvalid, "topic", topic.error().message);
    }
  }
  if (const auto text = fields.optional_text("status_topic")) {
    const bool is_topic = text->size() <= kLongestTopic &&
                          text->find_first_of("{}") == text->npos &&
                          TopicTemplate::parse(*text).has_value();
    if (!is_topic) {
      fields.report(ErrorCode::FieldInvalid, "status_topic",
                    "status_topic is a topic without names, such as plant/fitgauge/status");
    }
    options.status_topic = *text;
  }
  options.retain = fields.boolean_or("retain", true);
  read_follower(fields, errors, options.follower);
  return options;
}

std::unique_ptr<Outlet> make_mqtt(const MqttOptions& options, const Surroundings& around) {
  MqttOptions all = options;
  all.broker = named(all.broker, around.app.log().origin(), options.follower.name);
  if (all.status_topic.empty()) all.status_topic = topic_level(all.broker.client_id) + "/status";
  return std::make_unique<Mqtt>(all, around);
}

app::ConnectionTest test_broker(const Broker& broker, std::string_view connection,
                                const Surroundings& around, const std::stop_token& stop) {
  Broker probe = named(broker, around.app.log().origin(), connection);
  probe.client_id += "-test";  // the broker would send the connection itself away
  MqttClient client(probe, {}, [] {});
  if (auto failure = client.wait_connected(stop)) return {.ok = false, .detail = *failure};
  client.leave();
  return {.ok = true, .detail = "the broker accepts the connection"};
}

}  // namespace fitgauge::connections
