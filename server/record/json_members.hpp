#pragma once

#include <charconv>
#include <optional>
#include <string>
#include <string_view>

#include "base/digest.hpp"
#include "base/json/json_value.hpp"

namespace fitgauge::api {

/// The member's text; empty where it is none.
inline std::string text_of(const JsonValue& json, std::string_view name) {
  const JsonValue* value = json.find(name);
  return value != nullptr && value->is(JsonValue::Kind::String) ? value->text : std::string();
}

/// Reads what to_hex() writes; none where it is something else.
inline std::optional<Digest> digest_from_hex(std::string_view hex) {
  Digest digest{};
  if (hex.size() != 2 * digest.size()) return std::nullopt;
  for (std::size_t i = 0; i < digest.size(); ++i) {
    const char* const at = hex.data() + 2 * i;
    if (std::from_chars(at, at + 2, digest.at(i), 16).ptr != at + 2) return std::nullopt;
  }
  return digest;
}

}  // namespace fitgauge::api
