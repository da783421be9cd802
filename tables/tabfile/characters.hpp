#pragma once

namespace fitgauge::tabfile {

/// Columns of a table file are counted in characters: code points of the UTF-8 text.
constexpr bool starts_character(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U;
}

constexpr std::size_t count_characters(std::string_view text) {
  std::size_t count = 0;
  for (const char byte : text) count += starts_character(byte) ? 1U : 0U;
  return count;
}

/// The offset in bytes of the character `count` characters after the offset `from`, or the size.
constexpr std::size_t skip_characters(std::string_view text, std::size_t from, std::size_t count) {
  std::size_t i = from;
  for (; i < text.size(); ++i) {
    if (starts_character(text[i]) && count-- == 0) return i;
  }
  return i;
}

}  // namespace fitgauge::tabfile
