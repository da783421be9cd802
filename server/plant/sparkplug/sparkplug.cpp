#include "plant/sparkplug/sparkplug.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "plant/mqtt/mqtt_link.hpp"
#include "plant/sparkplug/edge_node.hpp"
#include "plant/sparkplug/host_state.hpp"

namespace fitgauge::connections {
namespace {

/// Of them the broker is asked at once whether it has taken them.
constexpr std::size_t kMostAtOnce = 64;
constexpr std::chrono::seconds kLongestSilence{20};
/// Between two looks whether the primary host is there.
constexpr std::chrono::seconds kHostPause{1};

class Sparkplug final : public Outlet {
 public:
  Sparkplug(const SparkplugOptions& options, const Plant& plant)
      : plant_(plant),
        options_(options),
        link_(options.broker),
        node_(options_, plant.clock,
              [this](MqttMessage message) { link_.client().publish(std::move(message)); }) {}
  ~Sparkplug() override { leave(); }

  void wake_by(std::function<void()> wake) override { link_.wake_by(std::move(wake)); }
  Delivery deliver(std::span<const Outgoing> measurements, const std::stop_token& stop) override;
  std::optional<Delivery> idle(const std::stop_token& stop) override;

 private:
  std::optional<std::string> connect(const std::stop_token& stop);
  std::optional<std::string> subscribe(const std::string& topic, const std::stop_token& stop);
  /// Connected, the host is there, and all are born. @returns why not.
  Delivery prepare(const std::stop_token& stop);
  /// Does what the messages say that have come. @returns whether the session goes on.
  bool obey();
  /// The node dies, and the connection ends.
  void leave();
  bool has_host() const { return options_.primary_host.empty() || host_.is_online(); }

  const Plant& plant_;
  const SparkplugOptions options_;
  MqttLink link_;
  EdgeNode node_;
  HostState host_;
  bool is_born_ = false;
};

std::optional<std::string> Sparkplug::subscribe(const std::string& topic,
                                                const std::stop_token& stop) {
  const auto ticket = link_.client().subscribe(topic, 1);
  const auto reason = link_.client().wait_settled(ticket, kLongestSilence, stop);
  if (reason == 0) return std::nullopt;
  return link_.give_up(reason ? fmt::format("it refuses to subscribe to {}", topic)
                              : "it does not answer");
}

std::optional<std::string> Sparkplug::connect(const std::stop_token& stop) {
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

bool Sparkplug::obey() {
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

void Sparkplug::leave() {
  if (link_.is_up()) {
    // Without a birth there is none to declare dead, and the will is dropped with the rest.
    if (is_born_) link_.client().publish(node_.death());
    link_.client().leave();
  }
  is_born_ = false;
}

Delivery Sparkplug::prepare(const std::stop_token& stop) {
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

std::optional<Delivery> Sparkplug::idle(const std::stop_token& stop) {
  const bool was_born = is_born_ && link_.is_up();
  Delivery delivery = prepare(stop);
  if (was_born && !delivery.failure) return std::nullopt;
  return delivery;
}

Delivery Sparkplug::deliver(std::span<const Outgoing> measurements, const std::stop_token& stop) {
  Delivery delivery = prepare(stop);
  if (delivery.failure) return delivery;
  const auto some = measurements.first(std::min(measurements.size(), kMostAtOnce));
  for (const Outgoing& outgoing : some) {
    // A command goes before data. A new connection would not know what went over the lost one.
    if (!link_.is_up() || !obey()) {
      delivery.failure = link_.give_up("the session has ended");
      return delivery;
    }
    node_.tell(**outgoing);
  }
  node_.tell_position((*some.back())->row);
  // Nobody is subscribed there, and the answer says that all before it was taken.
  const auto question = link_.client().unsubscribe(node_.topic("NDATA"));
  if (!link_.client().wait_settled(question, kLongestSilence, stop)) {
    if (!stop.stop_requested()) delivery.failure = link_.give_up("it does not answer");
    return delivery;
  }
  delivery.dealt_with = some.size();
  return delivery;
}

}  // namespace

std::unique_ptr<Outlet> make_sparkplug(const SparkplugOptions& options, const Plant& plant) {
  SparkplugOptions all = options;
  all.broker = named(all.broker, plant.origin, options.follower.name);
  return std::make_unique<Sparkplug>(all, plant);
}

}  // namespace fitgauge::connections
