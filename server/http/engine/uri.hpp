#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

namespace fitgauge::http {

/// Appends `text` with its %XX decoded (and `+` as a blank when asked for).
/// @returns false for an incomplete or non-hexadecimal %XX, a NUL, or bytes that are not UTF-8.
bool append_percent_decoded(std::string& out, std::string_view text, bool plus_is_blank);

namespace detail {
inline constexpr std::array<bool, 256> kPlainCharacters = [] {
  std::array<bool, 256> table{};
  for (std::size_t c = '!'; c <= '~'; ++c) table[c] = c != '%' && c != '+';
  return table;
}();
}  // namespace detail

/// What stands for itself in a path or query, neither to be decoded nor checked: printable ASCII
/// but for `%` and `+`.
constexpr bool is_plain(char c) { return detail::kPlainCharacters[static_cast<unsigned char>(c)]; }

/// host [":" port] as the Host field has it (RFC 3986 section 3.2.2, without user information).
bool is_authority(std::string_view text);

}  // namespace fitgauge::http
