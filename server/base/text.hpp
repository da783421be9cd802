#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace fitgauge {

/// The offset of the first byte that is not valid UTF-8 (RFC 3629: no surrogates, no overlong
/// forms), or npos.
std::size_t find_invalid_utf8(std::string_view text);

inline bool is_utf8(std::string_view text) {
  return find_invalid_utf8(text) == std::string_view::npos;
}

/// The first characters of `text` in at most `most` bytes; what is not UTF-8 ends them. A message
/// that cut a character in two could not be sent as JSON.
inline std::string_view first_characters(std::string_view text, std::size_t most) {
  text = text.substr(0, most);
  return text.substr(0, find_invalid_utf8(text));
}

/// Windows-1252 as UTF-8; the five bytes it does not define become the C1 controls of the same
/// number.
std::string utf8_from_windows1252(std::string_view bytes);

constexpr char ascii_upper(char c) {
  return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
}
constexpr char ascii_lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
constexpr bool is_ascii_letter(char c) { return ascii_upper(c) >= 'A' && ascii_upper(c) <= 'Z'; }
constexpr bool is_ascii_alphanumeric(char c) {
  return is_ascii_letter(c) || (c >= '0' && c <= '9');
}
std::string ascii_upper(std::string_view text);
std::string ascii_lower(std::string_view text);
bool ascii_iequals(std::string_view a, std::string_view b);

/// Without leading and trailing blanks and tabs.
std::string_view trim(std::string_view text);

/// Whether a name is of a pattern with `*` and `?`; letters count in either case.
bool matches_glob(std::string_view pattern, std::string_view name);

}  // namespace fitgauge
