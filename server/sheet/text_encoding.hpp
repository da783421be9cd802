#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/result.hpp"

namespace fitgauge::sheet {

enum class Encoding { Detected, Utf8, Utf16, Windows1252 };

/// `auto`, `utf-8`, `utf-16`, `windows-1252` (also `latin-1` and `iso-8859-1`), in either case.
std::optional<Encoding> encoding_from_word(std::string_view word);

/// The text as UTF-8 without a byte-order mark. Detected: what its mark says; UTF-16 where every
/// second byte of the beginning is 0; UTF-8 where it is valid; else Windows-1252. UTF-16 without a
/// mark is read in the order that its beginning shows, else little-endian.
/// @errors TextEncoding with the byte.
Result<std::string> to_utf8(std::string_view bytes, Encoding encoding);

}  // namespace fitgauge::sheet
