#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace fitgauge {

/// Whether a character of a JSON string stands as an escape (RFC 8259, 7).
constexpr bool needs_escape(char c) {
  return static_cast<unsigned char>(c) < 0x20 || c == '"' || c == '\\';
}

/// Room for one.
inline constexpr std::size_t kEscapeRoom = 6;

/// Writes it to where there is room, in the one spelling that RFC 8785 (3.2.2.2) allows.
/// @returns its end.
char* write_escape(char* to, char c);

/// `text` as a JSON string with its quotes.
void append_json_string(std::string& out, std::string_view text);

}  // namespace fitgauge
