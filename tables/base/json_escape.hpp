#pragma once

#include <cstddef>

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

}  // namespace fitgauge
