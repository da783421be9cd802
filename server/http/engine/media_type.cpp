#include "http/engine/media_type.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "base/text.hpp"
#include "http/field_list.hpp"

namespace fitgauge::http {

namespace {

bool is_token(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](char c) {
    return is_ascii_alphanumeric(c) ||
           std::string_view("!#$%&'*+-.^_`|~").find(c) != std::string_view::npos;
  });
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
    std::string_view parameters = take_part(accept, ',');
    const std::string_view range = take_part(parameters, ';');
    const int match = specificity(range, type);
    if (match > best_specificity) {
      best_specificity = match;
      best_quality = quality(parameters);
    }
  }
  return best_quality;
}

}  // namespace

std::optional<MediaType> parse_media_type(std::string_view text) {
  const std::string_view type = take_part(text, ';');
  const std::size_t slash = type.find('/');
  if (slash == std::string_view::npos || !is_token(type.substr(0, slash)) ||
      !is_token(type.substr(slash + 1))) {
    return std::nullopt;
  }
  MediaType out{ascii_lower(type), {}};
  while (!text.empty()) {
    const std::string_view part = take_part(text, ';');
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

Codings accepted_codings(std::string_view accept_encoding) {
  std::optional<int> gzip;
  std::optional<int> identity;
  std::optional<int> others;
  while (!accept_encoding.empty()) {
    std::string_view parameters = take_part(accept_encoding, ',');
    const std::string_view coding = take_part(parameters, ';');
    if (ascii_iequals(coding, "gzip") || ascii_iequals(coding, "x-gzip")) {
      gzip = quality(parameters);
    } else if (ascii_iequals(coding, "identity")) {
      identity = quality(parameters);
    } else if (coding == "*") {
      others = quality(parameters);
    }
  }
  Codings found;
  if (gzip || others) found.gzip = gzip ? *gzip : *others;
  if (identity || others) found.identity = identity ? *identity : *others;
  return found;
}

bool is_packable(std::string_view content_type) {
  const std::string_view type = take_part(content_type, ';');
  constexpr std::array<std::string_view, 6> kTypes{"application/json", "application/x-ndjson",
                                                   "text/csv",         "text/html",
                                                   "text/css",         "text/javascript"};
  return std::find(kTypes.begin(), kTypes.end(), type) != kTypes.end() || type.ends_with("+json") ||
         type.ends_with("/xml") || type.ends_with("+xml");
}

}  // namespace fitgauge::http
