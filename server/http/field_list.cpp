#include "http/field_list.hpp"

#include <algorithm>
#include <cstddef>

#include "base/text.hpp"

namespace fitgauge::http {

namespace {

/// A weight in thousandths; malformed counts as 0.
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
  if (out.value.size() >= 2 && out.value.front() == '"' && out.value.back() == '"') {
    out.value = out.value.substr(1, out.value.size() - 2);
  }
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

}  // namespace fitgauge::http
