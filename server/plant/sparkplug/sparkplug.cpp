#include "plant/sparkplug/edge_node.hpp"

#include "plant/kind.hpp"

namespace fitgauge::connections {
namespace {

/// Number of measurements after which the broker is asked for a confirmation.
constexpr std::size_t kMostAtOnce = 64;
/// Pause between two checks whether the primary host is online.
constexpr std::chrono::seconds kHostPause{1};

/// Each measurement is the data of a device. Data has QoS 0, as the specification requires, so a
/// measurement is done when the broker has answered a later request: it handles the packets of a
/// connection in their order.
class Sparkplug final : public Outlet {
 public:
  Sparkplug(const SparkplugOptions& options, const Plant& plant)
      : plant_(plant),
        options_(options),
        link_(options.broker),
        node_(options_, plant.clock,
              [this](MqttMessage message) { link_.client().send(std::move(message)); }) {}
  ~Sparkplug() override { leave(); }

  void wake_by(std::function<void()> wake) override { link_.wake_by(std::move(wake)); }

  Delivery deliver(std::span<const Outgoing> measurements, const std::stop_token& stop) override {
    Delivery delivery = prepare(stop);
    if (delivery.failure) return delivery;
    const auto some = measurements.first(std::min(measurements.size(), kMostAtOnce));
    for (const Outgoing& outgoing : some) {
      // Handles commands before data. A new connection would not know the messages of the lost one.
      if (!link_.is_up() || !obey()) {
        delivery.failure = link_.give_up("the session has ended");
        return delivery;
      }
      node_.tell(**outgoing);
    }
    node_.tell_position((*some.back())->row);
    // We have no subscription there: the answer shows that the broker has all earlier messages.
    const auto question = link_.client().unsubscribe(node_.topic("NDATA"));
    if (!link_.client().wait_settled(question, kLongestSilence, stop)) {
      if (!stop.stop_requested()) delivery.failure = link_.give_up("it does not answer");
      return delivery;
    }
    delivery.dealt_with = some.size();
    return delivery;
  }

  std::optional<Delivery> idle(const std::stop_token& stop) override {
    const bool was_born = is_born_ && link_.is_up();
    Delivery delivery = prepare(stop);
    if (was_born && !delivery.failure) return std::nullopt;
    return delivery;
  }

 private:
  std::optional<std::string> connect(const std::stop_token& stop) {
    if (link_.is_up()) return std::nullopt;
    is_born_ = false;
    host_.forget();
    const auto session = next_session(plant_.documents, options_.follower.name);
    if (!session) return session.error().message;
    node_.begin_session(*session);
    link_.set_will(node_.death());
    if (auto failure = link_.connect(stop)) return failure;
    if (auto failure = subscribe(node_.topic("NCMD"), stop)) return failure;
    if (options_.primary_host.empty()) return std::nullopt;
    return subscribe("spBv1.0/STATE/" + options_.primary_host, stop);
  }

  std::optional<std::string> subscribe(const std::string& topic, const std::stop_token& stop) {
    const auto ticket = link_.client().subscribe(topic);
    const auto reason = link_.client().wait_settled(ticket, kLongestSilence, stop);
    if (reason == 0) return std::nullopt;
    return reason ? link_.refused(fmt::format("it refuses to subscribe to {}", topic))
                  : link_.give_up("it does not answer");
  }

  /// Connects if necessary, checks the host, and sends the births. @returns why it failed.
  Delivery prepare(const std::stop_token& stop) {
    Delivery delivery{.failure = connect(stop)};
    if (delivery.failure) return delivery;
    if (!obey() || !has_host()) {
      delivery.failure = fmt::format("the primary host {} is not online", options_.primary_host);
      delivery.wait = kHostPause;
      return delivery;
    }
    if (!is_born_) {
      node_.give_birth();
      is_born_ = true;
    }
    return delivery;
  }

  /// Handles received messages. @returns whether the session continues.
  bool obey() {
    bool wants_birth = false;
    while (const auto message = link_.client().take_arrived()) {
      if (message->topic.starts_with("spBv1.0/STATE/")) {
        host_.take(message->payload);
      } else {
        wants_birth = asks_for_rebirth(message->payload) || wants_birth;
      }
      if (is_born_ && !has_host()) {
        leave();
        return false;
      }
    }
    if (wants_birth && is_born_) node_.give_birth();
    return true;
  }

  /// Sends the death of the node and ends the connection.
  void leave() {
    if (link_.is_up()) {
      // A node that was not born sends no death; the broker drops the will.
      if (is_born_) link_.client().send(node_.death());
      link_.client().leave();
    }
    is_born_ = false;
  }

  bool has_host() const { return options_.primary_host.empty() || host_.is_online(); }

  const Plant& plant_;
  const SparkplugOptions options_;
  MqttLink link_;
  EdgeNode node_;
  HostState host_;
  bool is_born_ = false;
};

/// The form of the id of a group, a node or a host: one level of a topic that needs no escapes.
auto level_id(std::string_view name) {
  return By{kLongestBrokerText, [name](std::string_view id) -> Result<std::string> {
              const bool is_id = !id.empty() && id.size() <= kLongestBrokerText &&
                                 id.find('%') == id.npos && id != "-" && topic_level(id) == id;
              if (!is_id) {
                return invalid_field(
                    fmt::format("{} must have 1 to {} bytes without + # / % and control characters",
                                name, kLongestBrokerText));
              }
              if (name == "group" && id == "STATE") {
                return invalid_field("group must not be STATE, the topic of the hosts");
              }
              return std::string(id);
            }};
}

}  // namespace

std::unique_ptr<Outlet> make(const SparkplugOptions& options, const Plant& plant) {
  SparkplugOptions all = options;
  all.broker = named(all.broker, plant.origin, options.follower.name);
  return std::make_unique<Sparkplug>(all, plant);
}

TestResult test_of(const SparkplugOptions& options, const Plant& plant,
                   const std::stop_token& stop) {
  return test_broker(options.broker, options.follower.name, plant, stop);
}

template <class V>
void members(V& v, SparkplugOptions& options) {
  broker_members(v, options.broker);
  v.member("group", options.group, level_id("group"), "Id of the Sparkplug group");
  v.member("node", options.node, level_id("node"), "Id of the edge node");
  v.optional("device", options.device, By{500, TopicTemplate::parse_level},
             "Name of a device (default: {machine}:{characteristic})");
  v.optional("primary_host", options.primary_host, level_id("primary_host"),
             "Primary host; nothing is sent while it is offline");
  v.optional("most_devices", options.most_devices, Within{1, 1000},
             "Largest number of devices (default: 1000)");
  follower_members(v, options.follower);
}

Kind sparkplug_kind() { return kind_of<SparkplugOptions>("sparkplug"); }

}  // namespace fitgauge::connections
