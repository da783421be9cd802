#include "plant/webhook/body_template.hpp"

#include <openssl/evp.h>
#include <openssl/hmac.h>

#include "base/digest.hpp"
#include "base/json/json_writer.hpp"
#include "http/client/http_client.hpp"
#include "plant/kind.hpp"
#include "record/record.hpp"

namespace fitgauge::connections {
namespace {

using http_client::HttpAnswer;
using namespace std::string_view_literals;

constexpr std::string_view kSecretPrefix = "whsec_";
constexpr std::size_t kShortestKey = 24;
constexpr std::size_t kLongestKey = 64;
constexpr std::size_t kMostKeys = 4;
constexpr std::size_t kLongestUrl = 2000;
constexpr std::size_t kLongestHeader = 100;
constexpr std::size_t kMostHeaders = 20;
constexpr int kMostAttempts = 5;  ///< of an event that the receiver does not understand

/// A receiver of webhooks.
struct WebhookOptions {
  FollowerOptions follower{};
  std::string url{};
  std::vector<std::string> keys{};  ///< bytes; each signs, so that receivers can change theirs
  std::chrono::seconds timeout{15};
  std::vector<std::string> headers{};  ///< lines of a request
  BodyTemplate body{};                 ///< empty: the unchanged event
};

Result<std::string> read_url(std::string_view text) {
  std::string url(text);
  const auto fault = url.size() > kLongestUrl
                         ? std::optional(fmt::format("url must have at most {} bytes", kLongestUrl))
                         : http_client::fault_of_url(url);
  if (fault) return invalid_field(*fault);
  return url;
}

Result<std::string> read_key(const JsonValue& item) {
  const auto key = item.is(JsonValue::Kind::String) ? webhook_key(item.text) : std::nullopt;
  if (key) return *key;
  return invalid_field(
      fmt::format("a secret must be {} and {} to {} bytes in base64, such as the output of `printf "
                  "whsec_; openssl rand -base64 32`",
                  kSecretPrefix, kShortestKey, kLongestKey));
}

/// Returns whether the request or the specification uses the name itself.
bool is_reserved(std::string_view name) {
  constexpr std::array kNames = {
      "connection"sv, "content-length"sv,    "content-type"sv, "host"sv,   "expect"sv,
      "te"sv,         "transfer-encoding"sv, "trailer"sv,      "upgrade"sv};
  return name.starts_with("webhook-") || std::ranges::find(kNames, name) != kNames.end();
}

/// Makes a line of a request. connections.cpp has replaced null by the stored value.
Result<std::string> read_header(std::string_view name, const JsonValue& value) {
  const auto is_token = [](char c) {
    return is_ascii_alphanumeric(c) ||
           std::string_view("!#$%&'*+-.^_`|~").find(c) != std::string_view::npos;
  };
  if (name.empty() || name.size() > kLongestHeader || !std::ranges::all_of(name, is_token)) {
    return invalid_field(
        fmt::format("a header name must have 1 to {} letters, digits and -", kLongestHeader));
  }
  if (is_reserved(ascii_lower(name))) {
    return invalid_field(fmt::format("{} is set by the service", name));
  }
  if (value.is(JsonValue::Kind::Null)) return invalid_field("no value is stored: give one");
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; };
  if (!value.is(JsonValue::Kind::String) || value.text.empty() || value.text.size() > kLongestUrl ||
      std::ranges::any_of(value.text, is_control)) {
    return invalid_field(fmt::format(
        "a header value must be a text of 1 to {} bytes without control characters", kLongestUrl));
  }
  return fmt::format("{}: {}", name, value.text);
}

struct BodyForm {
  std::string schema(api::Side) const { return "{}"; }
  bool read(api::FieldReader& fields, std::string_view name, BodyTemplate& to) const {
    const JsonValue* const given = fields.any(name);
    if (given == nullptr) return false;
    auto made = BodyTemplate::read(*given);
    if (!made) {
      fields.report(ErrorCode::FieldInvalid, name, made.error().message);
      return false;
    }
    to = *std::move(made);
    return true;
  }
};

template <class V>
void members(V& v, WebhookOptions& options) {
  v.member("url", options.url, By{kLongestUrl, read_url}, "https://host/path");
  v.optional("timeout_s", options.timeout, Within{1, 30}, "Timeout of a request (default: 15)");
  v.optional("headers", options.headers,
             EachMember{kMostHeaders, "headers ",
                        api::schema::null_or(api::schema::text(kLongestUrl)), read_header},
             "Headers of each request, as Authorization. Values are not shown; null keeps the "
             "stored value "
             "while the url stays, as leaving headers out does");
  v.optional("body", options.body, BodyForm{},
             "JSON with {{field}} of the event (default: the whole event)");
  event_members(v, options.follower);
  follower_members(v, options.follower);
  v.optional("secrets", options.keys, Each{kMostKeys, "secrets", api::schema::text(), read_key},
             "1 to 4 secrets, each whsec_ and 24 to 64 bytes in base64; each signs (default: the "
             "stored secrets)");
  v.check([](api::FieldReader& fields) {
    if (!fields.has("secrets")) static_cast<void>(fields.array("secrets"));
  });
}

std::string begun_event(std::string_view type, Timestamp time) {
  return fmt::format(R"({{"type":"{}","timestamp":"{}","data":)", type, format_rfc3339(time));
}

/// Whether the receiver refuses only this event, and not all.
bool is_of_the_event(long status) {
  constexpr std::array kStatuses = {400L, 413L, 415L, 422L};
  return std::ranges::find(kStatuses, status) != kStatuses.end();
}

std::string reason_of(const HttpAnswer& answer) {
  return answer.status == 0 ? answer.failure
                            : fmt::format("the receiver answers {}", answer.status);
}

class Webhook final : public Outlet {
 public:
  Webhook(const WebhookOptions& options, const Plant& plant)
      : plant_(plant), options_(options), client_({.may_reach_private = plant.may_reach_private}) {}

  Delivery deliver(std::span<const Outgoing> measurements, const std::stop_token& stop) override {
    return post(measurements, stop, [](const Outgoing& outgoing) {
      const app::Measurement& measurement = **outgoing;
      Posted posted{.id = app::measurement_id_text(measurement.id, measurement.origin),
                    .body = begun_event("measurement.recorded", measurement.received_at)};
      app::append_record(posted.body, measurement);
      posted.body += '}';
      return posted;
    });
  }

  Delivery deliver_events(std::span<const OutgoingEvent> events,
                          const std::stop_token& stop) override {
    return post(events, stop, [](const OutgoingEvent& event) {
      return Posted{.id = event_text(event),
                    .body = begun_event(event.type, event.at) + event.payload + '}'};
    });
  }

  /// @param event the body, or the input of the template
  HttpAnswer send(std::string_view id, std::string_view event, const std::stop_token& stop) {
    const std::string made = options_.body.is_empty() ? "" : options_.body.body_of(id, event);
    const std::string_view body = made.empty() ? event : made;
    // By the clock of the machine: received times, which may be ahead of it, would be refused.
    const std::string timestamp =
        std::to_string(SystemClock().now().nanoseconds / kNanosecondsPerSecond);
    std::vector<std::string> headers = {
        "Content-Type: application/json", fmt::format("webhook-id: {}", id),
        fmt::format("webhook-timestamp: {}", timestamp),
        fmt::format("webhook-signature: {}",
                    webhook_signature(options_.keys, id, timestamp, body))};
    headers.insert(headers.end(), options_.headers.begin(), options_.headers.end());
    return client_.call({.url = options_.url,
                         .headers = std::move(headers),
                         .body = body,
                         .timeout = options_.timeout},
                        [&stop] { return !stop.stop_requested(); });
  }

 private:
  struct Posted {
    std::string id;
    std::string body;
  };

  /// Posts the request that `compose` makes from each item, one by one.
  template <class Items, class Compose>
  Delivery post(const Items& items, const std::stop_token& stop, const Compose& compose) {
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

  const Plant& plant_;
  const WebhookOptions options_;
  http_client::HttpClient client_;
  int attempts_ = 0;  ///< of the first event that is not dealt with
};

/// Posts each measurement as an event `measurement.recorded` whose webhook-id is the measurement's,
/// and the other requested events. 2xx is success. 410 ends the connection. 400, 413, 415 and 422,
/// five times, make a dead letter. Anything else is repeated for ever.
std::unique_ptr<Outlet> make(const WebhookOptions& options, const Plant& plant) {
  return std::make_unique<Webhook>(options, plant);
}

/// Posts one event `connection.test` to the receiver.
TestResult test_of(const WebhookOptions& options, const Plant& plant, const std::stop_token& stop) {
  const Timestamp now = plant.clock.now();
  std::string body = begun_event("connection.test", now);
  api::JsonWriter(body).begin_object().member("connection", options.follower.name).end_object();
  body += '}';
  const HttpAnswer answer =
      Webhook(options, plant).send(fmt::format("test-{}", now.nanoseconds), body, stop);
  if (answer.status >= 200 && answer.status <= 299) return reason_of(answer);
  return Error{ErrorCode::NotReady, reason_of(answer)};
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
