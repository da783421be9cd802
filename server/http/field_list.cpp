#include "http/field_list.hpp"

namespace fitgauge::http {
namespace {

/// Returns a weight in thousandths; 0 if it is malformed.
int weight(std::string_view text) {
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

/// Whether two tags are of one representation, each in the plain or the gzip form.
bool is_same(std::string_view a, std::string_view b) {
  const auto take_end = [](std::string_view& tag) {
    const bool is_tag = tag.ends_with('"');
    if (is_tag) tag.remove_suffix(1);
    if (is_tag && tag.ends_with(kPackedEtagEnd)) tag.remove_suffix(kPackedEtagEnd.size());
    return is_tag;
  };
  return take_end(a) == take_end(b) && a == b;
}

template <class Matches>
bool names(std::string_view tags, const Matches& matches) {
  if (trim(tags) == "*") return true;
  while (!tags.empty()) {
    if (matches(take_part(tags, ','))) return true;
  }
  return false;
}

bool is_token(std::string_view text) {
  return !text.empty() && std::ranges::all_of(text, [](char c) {
    return is_ascii_alphanumeric(c) ||
           std::string_view("!#$%&'*+-.^_`|~").find(c) != std::string_view::npos;
  });
}

/// Returns how exactly a media range names a type: 0 not at all, 1 by */*, 2 by type/*, 3 exactly.
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

/// The weight of one type in the Accept value: of the most specific range.
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

std::string_view take_part(std::string_view& rest, char separator) {
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

std::vector<std::string_view> list_items(std::string_view value) {
  std::vector<std::string_view> items;
  while (!value.empty()) {
    if (const auto item = take_part(value, ','); !item.empty()) items.push_back(item);
  }
  return items;
}

NameValue split_parameter(std::string_view part) {
  const std::size_t equals = std::min(part.find('='), part.size());
  NameValue out{trim(part.substr(0, equals)), trim(part.substr(std::min(equals + 1, part.size())))};
  if (out.value.size() >= 2 && out.value.front() == '"' && out.value.back() == '"')
    out.value = out.value.substr(1, out.value.size() - 2);
  return out;
}

int quality(std::string_view parameters) {
  int found = 1000;
  while (!parameters.empty()) {
    const auto [name, value] = split_parameter(take_part(parameters, ';'));
    if (ascii_iequals(name, "q")) found = weight(value);
  }
  return found;
}

std::string packed_etag(std::string_view etag) {
  std::string packed(etag.substr(0, etag.size() - std::min<std::size_t>(etag.size(), 1)));
  return etag.empty() ? packed : packed.append(kPackedEtagEnd).append("\"");
}

bool names_etag_weakly(std::string_view tags, std::string_view etag) {
  const auto opaque = [](std::string_view tag) {
    return tag.starts_with("W/") ? tag.substr(2) : tag;
  };
  return names(tags, [&](std::string_view tag) { return is_same(opaque(tag), opaque(etag)); });
}

bool names_etag_strongly(std::string_view tags, std::string_view etag) {
  return names(tags,
               [&](std::string_view tag) { return !tag.starts_with("W/") && is_same(tag, etag); });
}

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
  return std::ranges::find(kTypes, type) != kTypes.end() || type.ends_with("+json") ||
         type.ends_with("/xml") || type.ends_with("+xml");
}

}  // namespace fitgauge::http
