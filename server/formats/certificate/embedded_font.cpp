#include "formats/certificate/tagged_pdf.hpp"

extern "C" {
extern const char fitgauge_font_begin[];  // font.S
extern const char fitgauge_font_end[];
}

namespace fitgauge::certificate {
namespace {

/// A number of the file: most significant byte first.
std::uint32_t number(std::string_view bytes, std::size_t at, std::size_t size) {
  std::uint32_t value = 0;
  for (const char byte : bytes.substr(at, size))
    value = value << 8 | static_cast<unsigned char>(byte);
  return value;
}

void append(std::string& out, std::size_t value, std::size_t size) {
  while (size-- > 0) out += static_cast<char>(value >> (8 * size) & 0xFF);
}

std::string_view table(std::string_view tag) {
  const std::string_view file(fitgauge_font_begin,
                              static_cast<std::size_t>(fitgauge_font_end - fitgauge_font_begin));
  for (std::size_t at = 12; at < 12 + 16 * number(file, 4, 2); at += 16) {
    if (file.substr(at, 4) == tag)
      return file.substr(number(file, at + 8, 4), number(file, at + 12, 4));
  }
  throw std::runtime_error("the compiled-in font has no table " + std::string(tag));
}

/// By the subtable of format 12, which has every character.
std::uint16_t glyph_of(char32_t character) {
  const std::string_view map = table("cmap");
  for (std::size_t entry = 4; entry < 4 + 8 * number(map, 2, 2); entry += 8) {
    const std::size_t at = number(map, entry + 4, 4);
    if (number(map, at, 2) != 12) continue;
    for (std::size_t group = at + 16; group < at + 16 + 12 * number(map, at + 12, 4); group += 12) {
      const std::uint32_t first = number(map, group, 4);
      if (character < first || number(map, group + 4, 4) < character) continue;
      return static_cast<std::uint16_t>(number(map, group + 8, 4) + character - first);
    }
  }
  return 0;
}

std::string_view outline(std::uint32_t glyph) {
  const std::string_view places = table("loca");
  const std::size_t begin = number(places, 4 * glyph, 4);
  return table("glyf").substr(begin, number(places, 4 * glyph + 4, 4) - begin);
}

/// Adds a glyph and its components.
void add_glyph(std::set<std::uint32_t>& glyphs, std::uint32_t glyph) {
  if (!glyphs.insert(glyph).second) return;
  const std::string_view form = outline(glyph);
  if (form.empty() || number(form, 0, 2) < 0x8000) return;
  constexpr std::uint32_t kWords = 1, kScale = 8, kMore = 0x20, kTwoScales = 0x40, kMatrix = 0x80;
  std::uint32_t flags = kMore;
  for (std::size_t at = 10; (flags & kMore) != 0;) {
    flags = number(form, at, 2);
    add_glyph(glyphs, number(form, at + 2, 2));
    at += (flags & kWords) != 0 ? 8U : 6U;
    at += (flags & kScale) != 0       ? 2U
          : (flags & kTwoScales) != 0 ? 4U
          : (flags & kMatrix) != 0    ? 8U
                                      : 0U;
  }
}

}  // namespace

EmbeddedFont::EmbeddedFont() { code(0); }

std::uint16_t EmbeddedFont::code(char32_t character) {
  if (used_.size() == 0xFFFF) return 0;
  const auto [known, is_new] =
      codes_.try_emplace(character, static_cast<std::uint16_t>(used_.size()));
  if (is_new) {
    const std::uint16_t glyph = glyph_of(character);
    const std::uint32_t last = number(table("hhea"), 34, 2) - 1;
    const std::uint32_t wide = number(table("hmtx"), 4 * std::min<std::uint32_t>(glyph, last), 2);
    used_.push_back(
        {character, glyph, static_cast<std::uint16_t>(wide * 1000 / number(table("head"), 18, 2))});
  }
  return known->second;
}

std::string EmbeddedFont::file() const {
  std::set<std::uint32_t> glyphs;
  for (const Used& used : used_) add_glyph(glyphs, used.glyph);
  std::string places;
  std::string forms;
  for (std::uint32_t glyph = 0; glyph < number(table("maxp"), 4, 2); ++glyph) {
    append(places, forms.size(), 4);
    if (glyphs.contains(glyph)) forms += outline(glyph);
  }
  append(places, forms.size(), 4);
  constexpr std::string_view kTables[] = {"cvt ", "fpgm", "glyf", "head", "hhea",
                                          "hmtx", "loca", "maxp", "prep"};
  std::string head("\0\1\0\0\0\x09\0\x80\0\3\0\x10", 12);
  std::string body;
  for (const std::string_view tag : kTables) {
    std::string bytes(tag == "glyf" ? forms : tag == "loca" ? places : table(tag));
    const std::size_t size = bytes.size();
    bytes.resize((size + 3) / 4 * 4);
    std::uint32_t sum = 0;
    for (std::size_t at = 0; at < bytes.size(); at += 4) sum += number(bytes, at, 4);
    head += tag;
    append(head, sum, 4);
    append(head, 12 + 16 * std::size(kTables) + body.size(), 4);
    append(head, size, 4);
    body += bytes;
  }
  return head + body;
}

}  // namespace fitgauge::certificate
