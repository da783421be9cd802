#include "http/engine/media_type.hpp"

#include <algorithm>
#include <cstddef>

#include "base/text.hpp"

namespace fitgauge::http {

namespace {

bool is_token(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return is_ascii_alphanumeric(c) ||
           std::string_view("!#$%&'*+-.^_`|~").find(c) != std::string_view::npos;
  });
}

/// Cuts `rest` at the next `separator` outside a quoted string.
std::string_view next_part(std::string_view& rest, char separator) {
  bool quoted = false;
  std::size_t i = 0;
  for (; i < rest.size() && (quoted || rest[i] != separator); ++i) {
    if (rest[i] == '"') quoted = !quoted;
    if (quoted && rest[i] == '\\') ++i;
  }
  i = std::min(i, rest.size());
  const std::string_view part = trim(rest.substr(0, i));
  rest.remove_prefix(std::min(i + 1, rest.size()));
  return part;
}

struct NameValue {
  std::string_view name;
  std::string_view value;
};

NameValue split_parameter(std::string_view part) {
  const std::size_t equals = std::min(part.find('='), part.size());
  NameValue out{part.substr(0, equals), part.substr(std::min(equals + 1, part.size()))};
  if (out.value.size() >= 2 && out.value.front() == '"' && out.value.back() == '"') {
    out.value = out.value.substr(1, out.value.size() - 2);
  }
  return out;
}

/// A weight in thousandths; malformed counts as 0.
int quality(std::string_view text) {
  if (text.empty() || text.size() > 5 || (text[0] != '0' && text[0] != '1')) return 0;
  int value = (text[0] - '0') * 1000;
  if (text.size() > 1 && text[1] != '.') return 0;
  int scale = 100;
  for (const char c : text.substr(std::min<std::size_t>(2, text.size()))) {
    if (c < '0' || c > '9') return 0;
    value += (c - '0') * scale;
    scale /= 10;
  }
  return std::min(value, 1000);
}

/// How exactly a media range names a type: 0 not at all, 1 by */*, 2 by type/*, 3 exactly.
int specificity(std::string_view range, std::string_view type) {
  if (range == "*/*") return 1;
  const std::size_t slash = range.find('/');
  if (slash == std::string_view::npos) return 0;
  if (range.substr(slash) == "/*") {
    return type.size() > slash &&
                   ascii_iequals(range.substr(0, slash + 1), type.substr(0, slash + 1))
               ? 2
               : 0;
  }
  return ascii_iequals(range, type) ? 3 : 0;
}

/// The weight the Accept value gives to one type: that of the most specific range.
int quality_of(std::string_view accept, std::string_view type) {
  int best_specificity = 0;
  int best_quality = 0;
  while (!accept.empty()) {
    std::string_view part = next_part(accept, ',');
    const std::string_view range = next_part(part, ';');
    int weight = 1000;
    while (!part.empty()) {
      const auto [name, value] = split_parameter(next_part(part, ';'));
      if (ascii_iequals(name, "q")) weight = quality(value);
    }
    const int match = specificity(range, type);
    if (match > best_specificity) {
      best_specificity = match;
      best_quality = weight;
    }
  }
  return best_quality;
}

}  // namespace

std::optional<MediaType> parse_media_type(std::string_view text) {
  const std::string_view type = next_part(text, ';');
  const std::size_t slash = type.find('/');
  if (slash == std::string_view::npos || !is_token(type.substr(0, slash)) ||
      !is_token(type.substr(slash + 1))) {
    return std::nullopt;
  }
  MediaType out{ascii_lower(type), {}};
  while (!text.empty()) {
    const std::string_view part = next_part(text, ';');
    if (part.empty()) continue;
    const auto [name, value] = split_parameter(part);
    if (!is_token(name) || value.empty()) return std::nullopt;
    if (ascii_iequals(name, "charset")) out.charset = ascii_lower(value);
  }
  return out;
}

const std::string* preferred_type(std::string_view accept,
                                  const std::vector<std::string>& offered) {
  const std::string* best = nullptr;
  int best_quality = 0;
  for (const std::string& type : offered) {
    const int weight = quality_of(accept, type);
    if (weight > best_quality) {
      best = &type;
      best_quality = weight;
    }
  }
  return best;
}

bool names_etag(std::string_view if_none_match, std::string_view etag) {
  const auto opaque = [](std::string_view tag) {
    return tag.starts_with("W/") ? tag.substr(2) : tag;
  };
  if (trim(if_none_match) == "*") return true;
  while (!if_none_match.empty()) {
    if (opaque(next_part(if_none_match, ',')) == opaque(etag)) return true;
  }
  return false;
}

}  // namespace fitgauge::http
