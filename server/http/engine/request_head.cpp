#include "http/engine/request_head.hpp"

namespace fitgauge::http {
namespace {

constexpr std::size_t kKeptFields = 32;

int hex_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  const char lower = ascii_lower(c);
  return lower >= 'a' && lower <= 'f' ? lower - 'a' + 10 : -1;
}

/// The characters of a reg-name or IPv4address: unreserved, sub-delims and %XX.
constexpr std::array<bool, 256> kHostCharacters = [] {
  std::array<bool, 256> table{};
  for (std::size_t i = 0; i < table.size(); ++i) {
    const char c = static_cast<char>(i);
    table[i] = is_ascii_alphanumeric(c) ||
               std::string_view("-._~%!$&'()*+,;=").find(c) != std::string_view::npos;
  }
  return table;
}();

// Objects, not functions: an algorithm calls them inline.
constexpr auto is_host_character = [](char c) {
  return kHostCharacters[static_cast<unsigned char>(c)];
};
constexpr auto is_ip_literal_character = [](char c) {
  return is_ascii_alphanumeric(c) || c == ':' || c == '.';
};

}  // namespace

std::optional<std::string_view> RequestHead::find(std::string_view name) const {
  for (const HeaderField& field : fields) {
    if (ascii_iequals(field.name, name)) return field.value;
  }
  return std::nullopt;
}

std::optional<std::string> RequestHead::find_list(std::string_view name) const {
  std::optional<std::string> joined;
  for (const HeaderField& field : fields) {
    if (!ascii_iequals(field.name, name)) continue;
    if (joined) {
      joined->append(", ").append(field.value);
    } else {
      joined.emplace(field.value);
    }
  }
  return joined;
}

void RequestHead::clear() {
  std::vector<HeaderField> kept = std::move(fields);
  kept.clear();
  if (kept.capacity() > kKeptFields) kept = {};
  *this = RequestHead{};
  fields = std::move(kept);
}

void RequestHead::rebase(const char* from, const char* to) {
  const auto move = [&](std::string_view& view) {
    if (view.data() != nullptr) view = {to + (view.data() - from), view.size()};
  };
  move(method);
  move(target);
  move(host);
  for (HeaderField& field : fields) {
    move(field.name);
    move(field.value);
  }
}

bool append_percent_decoded(std::string& out, std::string_view text, bool plus_is_blank) {
  const std::size_t start = out.size();
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (c == '%') {
      if (i + 2 >= text.size()) return false;
      const int high = hex_digit(text[i + 1]);
      const int low = hex_digit(text[i + 2]);
      if (high < 0 || low < 0) return false;
      c = static_cast<char>(high * 16 + low);
      i += 2;
    } else if (c == '+' && plus_is_blank) {
      c = ' ';
    }
    if (c == '\0') return false;
    out.push_back(c);
  }
  return is_utf8(std::string_view(out).substr(start));
}

bool is_authority(std::string_view text) {
  std::size_t host = 0;
  if (text.starts_with('[')) {
    const std::size_t end = text.find(']');
    if (end == std::string_view::npos || end == 1) return false;
    const std::string_view literal = text.substr(1, end - 1);
    if (!std::ranges::all_of(literal, is_ip_literal_character)) return false;
    host = end + 1;
  } else {
    while (host < text.size() && is_host_character(text[host])) ++host;
    if (host == 0) return false;
  }
  const std::string_view port = text.substr(host);
  if (port.empty()) return true;
  return port.front() == ':' && port.size() <= 6 &&
         std::all_of(port.begin() + 1, port.end(), [](char c) { return c >= '0' && c <= '9'; });
}

}  // namespace fitgauge::http
