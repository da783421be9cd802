#pragma once

#include <unordered_map>

namespace fitgauge::certificate {

/// Returns the character at `at`, and moves `at` after it. @pre at < text.size()
char32_t next_character(std::string_view text, std::size_t& at);

/// The compiled-in font (TrueType) for one document. Characters get codes from 1 in the order of
/// their use. A character that the font lacks is drawn as a box, but can be copied.
class EmbeddedFont {
 public:
  struct Used {
    char32_t character = 0;
    std::uint16_t glyph = 0;
    std::uint16_t width = 0;  ///< in thousandths of the size
  };

  EmbeddedFont();
  std::uint16_t code(char32_t character);
  std::size_t width(char32_t character) { return used_.at(code(character)).width; }
  const std::vector<Used>& used() const { return used_; }  ///< by code
  /// The font as a file with only the used glyphs.
  std::string file() const;

 private:
  std::vector<Used> used_;
  std::unordered_map<char32_t, std::uint16_t> codes_;
};

}  // namespace fitgauge::certificate
