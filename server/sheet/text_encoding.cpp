#include "sheet/text_encoding.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <utility>

#include "base/text.hpp"

namespace fitgauge::sheet {
namespace {

constexpr std::string_view kUtf8Mark = "\xEF\xBB\xBF";
constexpr std::string_view kLittleMark = "\xFF\xFE";
constexpr std::string_view kBigMark = "\xFE\xFF";
constexpr std::size_t kLooked = 64;  ///< bytes of the beginning

/// How many of the beginning's bytes at even or odd places are 0.
std::size_t zeros(std::string_view bytes, std::size_t parity) {
  std::size_t count = 0;
  for (std::size_t i = parity; i < std::min(bytes.size(), kLooked); i += 2) {
    if (bytes[i] == '\0') ++count;
  }
  return count;
}

bool looks_like_utf16(std::string_view bytes) {
  const std::size_t half = std::min(bytes.size(), kLooked) / 2;
  return half >= 2 && std::max(zeros(bytes, 0), zeros(bytes, 1)) * 4 >= half * 3;
}

void append_utf8(std::string& out, std::uint32_t point) {
  const auto put = [&out](std::uint32_t byte) { out += static_cast<char>(byte); };
  if (point < 0x80) {
    put(point);
  } else if (point < 0x800) {
    put(0xC0 | point >> 6);
    put(0x80 | (point & 0x3F));
  } else if (point < 0x10000) {
    put(0xE0 | point >> 12);
    put(0x80 | (point >> 6 & 0x3F));
    put(0x80 | (point & 0x3F));
  } else {
    put(0xF0 | point >> 18);
    put(0x80 | (point >> 12 & 0x3F));
    put(0x80 | (point >> 6 & 0x3F));
    put(0x80 | (point & 0x3F));
  }
}

Error no_utf16(std::size_t at) {
  return {ErrorCode::TextEncoding, fmt::format("byte {} is not UTF-16", at)};
}

Result<std::string> from_utf16(std::string_view bytes) {
  bool is_big = zeros(bytes, 0) > zeros(bytes, 1);
  if (bytes.starts_with(kLittleMark) || bytes.starts_with(kBigMark)) {
    is_big = bytes.starts_with(kBigMark);
    bytes.remove_prefix(2);
  }
  if (bytes.size() % 2 != 0) return no_utf16(bytes.size() - 1);
  const auto unit = [&](std::size_t at) {
    const auto first = static_cast<std::uint8_t>(bytes[at]);
    const auto second = static_cast<std::uint8_t>(bytes[at + 1]);
    return static_cast<std::uint32_t>(is_big ? first << 8 | second : second << 8 | first);
  };
  std::string out;
  out.reserve(bytes.size());
  for (std::size_t at = 0; at < bytes.size(); at += 2) {
    std::uint32_t point = unit(at);
    if (point >= 0xDC00 && point < 0xE000) return no_utf16(at);
    if (point >= 0xD800 && point < 0xDC00) {
      const std::uint32_t low = at + 3 < bytes.size() ? unit(at + 2) : 0;
      if (low < 0xDC00 || low >= 0xE000) return no_utf16(at);
      point = 0x10000 + ((point - 0xD800) << 10) + (low - 0xDC00);
      at += 2;
    }
    append_utf8(out, point);
  }
  return out;
}

}  // namespace

std::optional<Encoding> encoding_from_word(std::string_view word) {
  constexpr std::array<std::pair<std::string_view, Encoding>, 6> kWords = {
      {{"auto", Encoding::Detected},
       {"utf-8", Encoding::Utf8},
       {"utf-16", Encoding::Utf16},
       {"windows-1252", Encoding::Windows1252},
       {"latin-1", Encoding::Windows1252},
       {"iso-8859-1", Encoding::Windows1252}}};
  for (const auto& [known, encoding] : kWords) {
    if (ascii_iequals(word, known)) return encoding;
  }
  return std::nullopt;
}

Result<std::string> to_utf8(std::string_view bytes, Encoding encoding) {
  if (encoding == Encoding::Detected) {
    const bool is_marked = bytes.starts_with(kLittleMark) || bytes.starts_with(kBigMark);
    if (is_marked || looks_like_utf16(bytes)) {
      encoding = Encoding::Utf16;
    } else {
      encoding = is_utf8(bytes) ? Encoding::Utf8 : Encoding::Windows1252;
    }
  }
  if (encoding == Encoding::Utf16) return from_utf16(bytes);
  if (encoding == Encoding::Windows1252) return utf8_from_windows1252(bytes);
  if (bytes.starts_with(kUtf8Mark)) bytes.remove_prefix(kUtf8Mark.size());
  if (const std::size_t at = find_invalid_utf8(bytes); at != std::string_view::npos) {
    return Error{ErrorCode::TextEncoding,
                 fmt::format("byte {} is not UTF-8: name the encoding, such as windows-1252", at)};
  }
  return std::string(bytes);
}

}  // namespace fitgauge::sheet
