#include "plant/kind.hpp"
#include "plant/mqtt/mqtt_link.hpp"
#include "record/record.hpp"

namespace fitgauge::connections {
namespace {

constexpr std::size_t kMostAhead = 32;
constexpr std::size_t kLongestTopic = 500;

/// A broker that receives each measurement as a message.
struct MqttOptions {
  FollowerOptions follower{};
  Broker broker{};
  TopicTemplate topic{};
  std::string status_topic{};  ///< topic of `online` and of the last will `offline`
  std::string events_topic{};  ///< above the type of an event that is no measurement
  bool retain = true;
};

/// Reason codes of MQTT 5 about only the message (5.0, 3.4.2.1).
bool is_of_the_message(int reason) {
  constexpr int kTopicNameInvalid = 0x90;
  constexpr int kPayloadFormatInvalid = 0x99;
  return reason == kTopicNameInvalid || reason == kPayloadFormatInvalid ||
         reason == MqttClient::kCannotBeSent;
}

/// Publishes each measurement's record with QoS 1, in order and at most 32 ahead of the broker's
/// acknowledgements; a measurement is done when its acknowledgement and all earlier ones have
/// arrived. A message that the broker refuses for good (MQTT 5) is a dead letter. Stays connected
/// between.
class Mqtt final : public Outlet {
 public:
  Mqtt(const MqttOptions& options, const Plant& plant)
      : plant_(plant),
        options_(options),
        link_(options.broker,
              MqttMessage{.topic = options.status_topic, .payload = "offline", .retain = true}) {}

  ~Mqtt() override {
    if (!link_.is_up()) return;
    link_.client().send({.topic = options_.status_topic, .payload = "offline", .retain = true});
    link_.client().leave();
  }

  void wake_by(std::function<void()> wake) override { link_.wake_by(std::move(wake)); }

  Delivery deliver(std::span<const Outgoing> measurements, const std::stop_token& stop) override {
    return publish(measurements, stop, [this](const Outgoing& outgoing) {
      const app::Measurement& measurement = **outgoing;
      Published published{
          .id = app::measurement_id_text(measurement.id, measurement.origin),
          .message = {.topic = options_.topic.topic_of(measurement), .retain = options_.retain}};
      app::append_record(published.message.payload, measurement);
      return published;
    });
  }

  Delivery deliver_events(std::span<const OutgoingEvent> events,
                          const std::stop_token& stop) override {
    return publish(events, stop, [this](const OutgoingEvent& event) {
      const std::string id = event_text(event);
      return Published{
          .id = id,
          .message = {.topic = fmt::format("{}/{}", options_.events_topic, event.type),
                      .payload = fmt::format(R"({{"id":"{}","at":"{}","data":{}}})", id,
                                             format_rfc3339(event.at), event.payload)}};
    });
  }

  std::optional<Delivery> idle(const std::stop_token& stop) override {
    if (link_.is_up()) return std::nullopt;
    return Delivery{.failure = connect(stop)};
  }

 private:
  struct Published {
    std::string id;
    MqttMessage message;
  };

  std::optional<std::string> connect(const std::stop_token& stop) {
    if (link_.is_up()) return std::nullopt;
    if (auto failure = link_.connect(stop)) return failure;
    link_.client().send({.topic = options_.status_topic, .payload = "online", .retain = true});
    return std::nullopt;
  }

  /// Publishes the message that `compose` makes from each item, in order.
  template <class Items, class Compose>
  Delivery publish(const Items& items, const std::stop_token& stop, const Compose& compose) {
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
      // Silence after a pause of this thread shows nothing about the broker.
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
        // A broker out of step: a new connection sends pending messages again.
        delivery.failure = reason ? link_.refused(mqtt_reason(*reason))
                                  : link_.give_up("the broker does not acknowledge messages");
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

  const Plant& plant_;
  const MqttOptions options_;
  MqttLink link_;
};

/// The form of a topic without {names} of fields.
auto plain_topic(std::string_view name) {
  return By{kLongestTopic, [name](std::string_view text) -> Result<std::string> {
              const bool is_topic = text.size() <= kLongestTopic &&
                                    text.find_first_of("{}") == text.npos &&
                                    TopicTemplate::parse(text).has_value();
              if (is_topic) return std::string(text);
              return invalid_field(fmt::format(
                  "{} must be a topic without {{names}}, such as plant/fitgauge/status", name));
            }};
}

template <class V>
void members(V& v, MqttOptions& options) {
  broker_members(v, options.broker);
  v.member("topic", options.topic, By{kLongestTopic, TopicTemplate::parse},
           "plant/{machine}/{characteristic}");
  v.optional("version", options.broker.version_5, Choice{"3.1.1", "5"},
             "Version of MQTT (default: 3.1.1)");
  v.optional("status_topic", options.status_topic, plain_topic("status_topic"),
             "Topic of online and offline (default: client_id/status)");
  v.optional("events_topic", options.events_topic, plain_topic("events_topic"),
             "Topic before the type of an event (default: client_id/events)");
  v.optional("retain", options.retain, Truth{},
             "The broker keeps the last message of each topic (default: true)");
  event_members(v, options.follower);
  follower_members(v, options.follower);
}

std::unique_ptr<Outlet> make(const MqttOptions& options, const Plant& plant) {
  MqttOptions all = options;
  all.broker = named(all.broker, plant.origin, options.follower.name);
  const std::string own = topic_level(all.broker.client_id);
  if (all.status_topic.empty()) all.status_topic = own + "/status";
  if (all.events_topic.empty()) all.events_topic = own + "/events";
  return std::make_unique<Mqtt>(all, plant);
}

TestResult test_of(const MqttOptions& options, const Plant& plant, const std::stop_token& stop) {
  return test_broker(options.broker, options.follower.name, plant, stop);
}

}  // namespace

Kind mqtt_kind() { return kind_of<MqttOptions>("mqtt"); }

}  // namespace fitgauge::connections
