#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fitgauge::connections {

/// The bytes of a secret: `whsec_` and 24 to 64 bytes in base64. @returns none for anything else.
std::optional<std::string> webhook_key(std::string_view secret);

/// The value of webhook-signature: `v1,` and the HMAC-SHA256 of `id.timestamp.body` in base64, one
/// for each key (Standard Webhooks, "Signature scheme").
std::string webhook_signature(const std::vector<std::string>& keys, std::string_view id,
                              std::string_view timestamp, std::string_view body);

}  // namespace fitgauge::connections
