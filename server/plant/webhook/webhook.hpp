#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/json/field_reader.hpp"
#include "plant/log_follower.hpp"

namespace fitgauge::connections {

/// A receiver of webhooks.
struct WebhookOptions {
  FollowerOptions follower{};
  std::string url{};
  std::vector<std::string> keys{};  ///< bytes; each signs, so that a receiver may change its own
  std::chrono::seconds timeout{15};
};

/// The bytes of a secret: `whsec_` and 24 to 64 bytes in base64. @returns none for anything else.
std::optional<std::string> webhook_key(std::string_view secret);

/// The value of webhook-signature: `v1,` and the HMAC-SHA256 of `id.timestamp.body` in base64, one
/// for each key (Standard Webhooks, "Signature scheme").
std::string webhook_signature(const std::vector<std::string>& keys, std::string_view id,
                              std::string_view timestamp, std::string_view body);

/// Reads what the kind webhook takes: `url`, `secrets`, `filter`, `events`, `start`,
/// `timeout_s`, `longest_wait_s`. What is wrong goes to `errors`.
WebhookOptions read_webhook(std::string_view name, api::FieldReader& fields,
                            api::FieldErrors& errors);

/// Posts each measurement as an event `measurement.recorded` whose webhook-id is the measurement's,
/// and the other events that were asked for.
/// 2xx is taken. 410 ends the connection. 400, 413, 415 and 422, five times, make a dead letter.
/// Anything else is repeated for ever. @param plant outlives it.
std::unique_ptr<Outlet> make_webhook(const WebhookOptions& options, const Plant& plant);

/// Posts one event `connection.test`.
ConnectionTest test_webhook(const WebhookOptions& options, const Plant& plant,
                            const std::stop_token& stop);

}  // namespace fitgauge::connections
