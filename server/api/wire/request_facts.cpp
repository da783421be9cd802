#include "api/wire/request_facts.hpp"

#include <algorithm>

#include "api/service/caller.hpp"
#include "base/text.hpp"

namespace fitgauge::api {
namespace {

std::vector<std::string_view> list_items(std::string_view text, std::string_view separators) {
  std::vector<std::string_view> items;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(separators), text.size());
    if (const auto item = trim(text.substr(0, end)); !item.empty()) items.push_back(item);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return items;
}

}  // namespace

Preference preference_of(const http::Request& request) {
  const auto header = request.header_list("Prefer");
  if (!header) return Preference::None;
  // The first of several counts (RFC 7240, 2).
  for (const std::string_view preference : list_items(*header, ",;")) {
    const std::size_t equals = preference.find('=');
    if (equals == std::string_view::npos ||
        !ascii_iequals(trim(preference.substr(0, equals)), "return")) {
      continue;
    }
    std::string_view value = trim(preference.substr(equals + 1));
    if (value.size() >= 2 && value.front() == '"' && value.back() == '"') {
      value = value.substr(1, value.size() - 2);
    }
    if (value == "minimal") return Preference::Minimal;
    if (value == "representation") return Preference::Representation;
  }
  return Preference::None;
}

bool prefers_async(const http::Request& request) {
  const auto header = request.header_list("Prefer");
  if (!header) return false;
  const auto preferences = list_items(*header, ",;");
  return std::any_of(preferences.begin(), preferences.end(),
                     [](std::string_view item) { return ascii_iequals(item, "respond-async"); });
}

bool accepts_gzip(const http::Request& request) {
  const auto header = request.header_list("Accept-Encoding");
  if (!header) return false;
  const auto is_taken = [](std::string_view coding) {
    const auto parts = list_items(coding, ";");
    if (parts.empty() || !ascii_iequals(parts.front(), "gzip")) return false;
    const std::string_view weight = parts.size() > 1 ? parts[1] : "q=1";
    return weight.find_first_of("123456789") != std::string_view::npos;
  };
  const auto codings = list_items(*header, ",");
  return std::any_of(codings.begin(), codings.end(), is_taken);
}

Result<std::optional<std::string>> idempotency_key(const http::Request& request) {
  constexpr std::size_t kLongest = 255;
  const auto header = request.header("Idempotency-Key");
  if (!header) return std::optional<std::string>();
  if (request.header_list("Idempotency-Key") != *header) {
    return Error{ErrorCode::IdempotencyKeyInvalid, "send one Idempotency-Key"};
  }
  std::string_view key = trim(*header);
  if (key.size() >= 2 && key.front() == '"' && key.back() == '"') {
    key = key.substr(1, key.size() - 2);
  }
  const bool visible =
      std::all_of(key.begin(), key.end(), [](char c) { return c >= ' ' && c <= '~'; });
  if (key.empty() || key.size() > kLongest || !visible) {
    return Error{ErrorCode::IdempotencyKeyInvalid,
                 "an Idempotency-Key has 1 to 255 visible ASCII characters"};
  }
  return std::optional(std::string(key));
}

std::optional<std::vector<std::string>> revisions_to_match(const http::Request& request) {
  const auto header = request.header_list("If-Match");
  if (!header || trim(*header) == "*") return std::nullopt;
  std::vector<std::string> revisions;
  for (std::string_view tag : list_items(*header, ",")) {
    // If-Match compares strongly: a weak tag never matches (RFC 9110, 13.1.1).
    if (tag.size() < 2 || tag.front() != '"' || tag.back() != '"') continue;
    tag = tag.substr(1, tag.size() - 2);
    revisions.emplace_back(tag.substr(0, tag.find('.')));
  }
  return revisions;
}

std::optional<std::string_view> caller_name(const http::Request& request) {
  const auto* caller = request.caller<Caller>();
  if (caller == nullptr || caller->name.empty()) return std::nullopt;
  return std::string_view(caller->name);
}

}  // namespace fitgauge::api
