#include "plant/webhook/webhook.hpp"

#include <fmt/format.h>
#include <openssl/evp.h>
#include <openssl/hmac.h>

#include <algorithm>
#include <array>

#include "base/base64.hpp"
#include "base/json/json_writer.hpp"
#include "base/text.hpp"
#include "http/client/http_client.hpp"
#include "plant/follower_settings.hpp"
#include "plant/kind.hpp"
#include "record/record.hpp"

namespace fitgauge::connections {
namespace {

using http_client::HttpAnswer;

constexpr std::string_view kSecretPrefix = "whsec_";
constexpr std::size_t kShortestKey = 24;
constexpr std::size_t kLongestKey = 64;
constexpr std::size_t kMostKeys = 4;
constexpr std::size_t kLongestUrl = 2000;
constexpr int kMostAttempts = 5;  ///< of an event that the receiver does not understand

/// A receiver of webhooks.
struct WebhookOptions {
  FollowerOptions follower{};
  std::string url{};
  std::vector<std::string> keys{};  ///< bytes; each signs, so that a receiver may change its own
  std::chrono::seconds timeout{15};
};

Result<std::string> read_url(std::string_view text) {
  std::string url(text);
  const auto fault = url.size() > kLongestUrl
                         ? std::optional(fmt::format("at most {} bytes", kLongestUrl))
                         : http_client::fault_of_url(url);
  if (fault) return invalid_field(*fault);
  return url;
}

Result<std::string> read_key(const JsonValue& item) {
  const auto key = item.is(JsonValue::Kind::String) ? webhook_key(item.text) : std::nullopt;
  if (key) return *key;
  return invalid_field(
      fmt::format("a secret is {} and {} to {} bytes in base64, as `printf "
                  "whsec_; openssl rand -base64 32` makes one",
                  kSecretPrefix, kShortestKey, kLongestKey));
}

template <class V>
void members(V& v, WebhookOptions& options) {
  v.member("url", options.url, By{kLongestUrl, read_url}, "https://host/path");
  v.optional("timeout_s", options.timeout, Within{1, 30}, "Of a request; 15 when absent");
  event_members(v, options.follower);
  follower_members(v, options.follower);
  v.optional(
      "secrets", options.keys, Each{1, kMostKeys, "secrets", api::schema::text(), read_key},
      "1 to 4, whsec_ and 24 to 64 bytes in base64; each signs. Those there are when absent");
  v.check([](api::FieldReader& fields) {
    if (!fields.has("secrets")) static_cast<void>(fields.array("secrets"));
  });
}

std::string begun_event(std::string_view type, Timestamp time) {
  return fmt::format(R"({{"type":"{}","timestamp":"{}","data":)", type, format_rfc3339(time));
}

/// Whether the receiver says that this event, and not all, is what it cannot take.
bool is_of_the_event(long status) {
  constexpr std::array kStatuses = {400L, 413L, 415L, 422L};
  return std::find(kStatuses.begin(), kStatuses.end(), status) != kStatuses.end();
}

std::string reason_of(const HttpAnswer& answer) {
  return answer.status == 0 ? answer.failure
                            : fmt::format("the receiver answers {}", answer.status);
}

class Webhook final : public Outlet {
 public:
  Webhook(const WebhookOptions& options, const Plant& plant)
      : plant_(plant), options_(options), client_({.may_reach_private = plant.may_reach_private}) {}

  Delivery deliver(std::span<const Outgoing> measurements, const std::stop_token& stop) override;
  Delivery deliver_events(std::span<const OutgoingEvent> events,
                          const std::stop_token& stop) override;
  HttpAnswer send(std::string_view id, std::string_view body, const std::stop_token& stop);

 private:
  struct Posted {
    std::string id;
    std::string body;
  };
  /// Posts one after the other what `compose` makes of each.
  template <class Items, class Compose>
  Delivery post(const Items& items, const std::stop_token& stop, const Compose& compose);

  const Plant& plant_;
  const WebhookOptions options_;
  http_client::HttpClient client_;
  int attempts_ = 0;  ///< of the first event that is not dealt with
};

HttpAnswer Webhook::send(std::string_view id, std::string_view body, const std::stop_token& stop) {
  const std::string timestamp =
      std::to_string(plant_.clock.now().nanoseconds / kNanosecondsPerSecond);
  return client_.call(
      {.url = options_.url,
       .headers = {"Content-Type: application/json", fmt::format("webhook-id: {}", id),
                   fmt::format("webhook-timestamp: {}", timestamp),
                   fmt::format("webhook-signature: {}",
                               webhook_signature(options_.keys, id, timestamp, body))},
       .body = body,
       .timeout = options_.timeout},
      [&stop] { return !stop.stop_requested(); });
}

template <class Items, class Compose>
Delivery Webhook::post(const Items& items, const std::stop_token& stop, const Compose& compose) {
  Delivery delivery;
  const auto until = std::chrono::steady_clock::now() + kLongestStretch;
  for (const auto& item : items) {
    const Posted posted = compose(item);
    const HttpAnswer answer = send(posted.id, posted.body, stop);
    ++attempts_;
    if (answer.status < 200 || answer.status > 299) {
      const bool is_given_up = is_of_the_event(answer.status) && attempts_ >= kMostAttempts;
      if (!is_given_up) {
        delivery.failure = reason_of(answer);
        delivery.wait = answer.retry_after;
        delivery.wants_no_more = answer.status == 410;
        return delivery;
      }
      delivery.refused.push_back(
          {.measurement = posted.id, .reason = reason_of(answer), .at = plant_.clock.now()});
    }
    attempts_ = 0;
    ++delivery.dealt_with;
    delivery.bytes += posted.body.size();
    if (std::chrono::steady_clock::now() > until) break;
  }
  return delivery;
}

Delivery Webhook::deliver(std::span<const Outgoing> measurements, const std::stop_token& stop) {
  return post(measurements, stop, [](const Outgoing& outgoing) {
    const app::Measurement& measurement = **outgoing;
    Posted posted{.id = app::measurement_id_text(measurement.id, measurement.origin),
                  .body = begun_event("measurement.recorded", measurement.received_at)};
    app::append_record(posted.body, measurement);
    posted.body += '}';
    return posted;
  });
}

Delivery Webhook::deliver_events(std::span<const OutgoingEvent> events,
                                 const std::stop_token& stop) {
  const std::string_view origin = plant_.origin;
  return post(events, stop, [origin](const OutgoingEvent& event) {
    return Posted{.id = event_text(event, origin),
                  .body = begun_event(event.type, event.at) + event.payload + '}'};
  });
}

/// Posts each measurement as an event `measurement.recorded` whose webhook-id is the measurement's,
/// and the other events that were asked for.
/// 2xx is taken. 410 ends the connection. 400, 413, 415 and 422, five times, make a dead letter.
/// Anything else is repeated for ever.
std::unique_ptr<Outlet> make(const WebhookOptions& options, const Plant& plant) {
  return std::make_unique<Webhook>(options, plant);
}

/// Posts one event `connection.test`.
ConnectionTest test_of(const WebhookOptions& options, const Plant& plant,
                       const std::stop_token& stop) {
  const Timestamp now = plant.clock.now();
  std::string body = begun_event("connection.test", now);
  api::JsonWriter(body).begin_object().member("connection", options.follower.name).end_object();
  body += '}';
  const HttpAnswer answer =
      Webhook(options, plant).send(fmt::format("test-{}", now.nanoseconds), body, stop);
  const bool ok = answer.status >= 200 && answer.status <= 299;
  return {.ok = ok, .detail = reason_of(answer)};
}

}  // namespace

std::optional<std::string> webhook_key(std::string_view secret) {
  if (!secret.starts_with(kSecretPrefix)) return std::nullopt;
  const auto bytes = tlog::from_base64(secret.substr(kSecretPrefix.size()));
  if (!bytes || bytes->size() < kShortestKey || bytes->size() > kLongestKey) return std::nullopt;
  return std::string(bytes->begin(), bytes->end());
}

std::string webhook_signature(const std::vector<std::string>& keys, std::string_view id,
                              std::string_view timestamp, std::string_view body) {
  const std::string content = fmt::format("{}.{}.{}", id, timestamp, body);
  std::string signatures;
  for (const std::string& key : keys) {
    std::array<std::uint8_t, EVP_MAX_MD_SIZE> digest;
    unsigned size = 0;
    HMAC(EVP_sha256(), key.data(), static_cast<int>(key.size()),
         reinterpret_cast<const unsigned char*>(content.data()), content.size(), digest.data(),
         &size);
    signatures += fmt::format("{}v1,{}", signatures.empty() ? "" : " ",
                              tlog::to_base64({digest.data(), size}));
  }
  return signatures;
}

Kind webhook_kind() { return kind_of<WebhookOptions>("webhook"); }

}  // namespace fitgauge::connections
