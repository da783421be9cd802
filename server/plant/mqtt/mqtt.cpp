#include "plant/mqtt/mqtt.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <deque>

#include "plant/mqtt/mqtt_link.hpp"
#include "record/record.hpp"
#include "service/log/log_service.hpp"

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
  Mqtt(const MqttOptions& options, const Plant& plant)
      : plant_(plant),
        options_(options),
        link_(options.broker,
              MqttMessage{.topic = options.status_topic, .payload = "offline", .retain = true}) {}
  ~Mqtt() override;

  void wake_by(std::function<void()> wake) override { link_.wake_by(std::move(wake)); }
  Delivery deliver(std::span<const Outgoing> measurements, const std::stop_token& stop) override;
  Delivery deliver_events(std::span<const OutgoingEvent> events,
                          const std::stop_token& stop) override;
  std::optional<Delivery> idle(const std::stop_token& stop) override;

 private:
  struct Published {
    std::string id;
    MqttMessage message;
  };

  std::optional<std::string> connect(const std::stop_token& stop);
  /// Publishes in order what `compose` makes of each.
  template <class Items, class Compose>
  Delivery publish(const Items& items, const std::stop_token& stop, const Compose& compose);

  const Plant& plant_;
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

Delivery Mqtt::deliver(std::span<const Outgoing> measurements, const std::stop_token& stop) {
  return publish(measurements, stop, [this](const Outgoing& outgoing) {
    const app::Measurement& measurement = **outgoing;
    Published published{
        .id = app::measurement_id_text(measurement.id, measurement.origin),
        .message = {.topic = options_.topic.topic_of(measurement), .retain = options_.retain}};
    app::append_record(published.message.payload, measurement);
    return published;
  });
}

Delivery Mqtt::deliver_events(std::span<const OutgoingEvent> events, const std::stop_token& stop) {
  const std::string_view origin = plant_.origin;
  return publish(events, stop, [this, origin](const OutgoingEvent& event) {
    const std::string id = event_text(event, origin);
    return Published{.id = id,
                     .message = {.topic = fmt::format("{}/{}", options_.events_topic, event.type),
                                 .payload = fmt::format(R"({{"id":"{}","at":"{}","data":{}}})", id,
                                                        format_rfc3339(event.at), event.payload)}};
  });
}

template <class Items, class Compose>
Delivery Mqtt::publish(const Items& items, const std::stop_token& stop, const Compose& compose) {
  Delivery delivery{.failure = connect(stop)};
  if (delivery.failure) return delivery;
  const auto until = std::chrono::steady_clock::now() + kLongestStretch;
  struct Ahead {
    std::string id;
    MqttClient::Ticket ticket;
  };
  std::deque<Ahead> ahead;
  std::size_t sent = 0;
  while (true) {
    // Also where the thread stood still meanwhile: what sends nothing tells nothing of the broker.
    const bool is_in_time = sent == 0 || std::chrono::steady_clock::now() < until;
    const bool sends_more = is_in_time && !stop.stop_requested();
    while (sends_more && sent < items.size() && ahead.size() < kMostAhead) {
      Published published = compose(items[sent++]);
      ahead.push_back(
          {std::move(published.id), link_.client().publish(std::move(published.message))});
    }
    if (ahead.empty()) return delivery;
    const auto reason = link_.client().wait_settled(ahead.front().ticket, kLongestSilence, stop);
    if (!reason || (*reason != 0 && !is_of_the_message(*reason))) {
      if (stop.stop_requested()) return delivery;
      // What is on its way comes again over a new connection: a broker that is out of step ends.
      delivery.failure =
          link_.give_up(reason ? mqtt_reason(*reason) : "it does not acknowledge what it is sent");
      return delivery;
    }
    if (*reason != 0) {
      delivery.refused.push_back({.measurement = ahead.front().id,
                                  .reason = mqtt_reason(*reason),
                                  .at = plant_.clock.now()});
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

namespace {

/// A topic without names; empty where there is none.
std::string read_plain_topic(api::FieldReader& fields, std::string_view name) {
  const auto text = fields.optional_text(name);
  if (!text) return {};
  const bool is_topic = text->size() <= kLongestTopic && text->find_first_of("{}") == text->npos &&
                        TopicTemplate::parse(*text).has_value();
  if (!is_topic) {
    fields.report(ErrorCode::FieldInvalid, name,
                  fmt::format("{} is a topic without names, such as plant/fitgauge/status", name));
  }
  return *text;
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
  options.status_topic = read_plain_topic(fields, "status_topic");
  options.events_topic = read_plain_topic(fields, "events_topic");
  options.retain = fields.boolean_or("retain", true);
  read_follower(fields, errors, options.follower);
  read_events(fields, options.follower);
  return options;
}

std::unique_ptr<Outlet> make_mqtt(const MqttOptions& options, const Plant& plant) {
  MqttOptions all = options;
  all.broker = named(all.broker, plant.origin, options.follower.name);
  const std::string own = topic_level(all.broker.client_id);
  if (all.status_topic.empty()) all.status_topic = own + "/status";
  if (all.events_topic.empty()) all.events_topic = own + "/events";
  return std::make_unique<Mqtt>(all, plant);
}

ConnectionTest test_broker(const Broker& broker, std::string_view connection, const Plant& plant,
                           const std::stop_token& stop) {
  Broker probe = named(broker, plant.origin, connection);
  probe.client_id += "-test";  // the broker would send the connection itself away
  MqttClient client(probe, {}, [] {});
  if (auto failure = client.wait_connected(stop)) return {.ok = false, .detail = *failure};
  client.leave();
  return {.ok = true, .detail = "the broker accepts the connection"};
}

}  // namespace fitgauge::connections
